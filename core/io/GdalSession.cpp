// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/GdalSession.h"

#include <cpl_error.h>
#include <mutex>

namespace reflet {

GdalSession::GdalSession() {
    static std::once_flag registered;
    std::call_once(registered, [] { GDALAllRegister(); });
    CPLPushErrorHandlerEx(&GdalSession::keep, this);  // a stack of its own for each thread
}

GdalSession::~GdalSession() {
    CPLPopErrorHandler();
}

void GdalSession::keep(CPLErr level, CPLErrorNum /*number*/, const char* text) {
    auto* const session = static_cast<GdalSession*>(CPLGetErrorHandlerUserData());
    if (level >= CE_Failure && session->m_failure.empty())
        session->m_failure = text[0] == '\0' ? "unknown failure" : text;
    else if (level == CE_Warning)
        session->m_warning = text;
}

}  // namespace reflet
