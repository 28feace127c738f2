// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/ProjHandles.h"

#include <utility>

namespace reflet {

ProjContext::ProjContext()
    : m_message(std::make_unique<std::string>()), m_context(proj_context_create()) {
    proj_log_func(m_context.get(), m_message.get(), [](void* message, int, const char* text) {
        *static_cast<std::string*>(message) = text;
    });
    proj_context_set_enable_network(m_context.get(), 0);
}

std::string ProjContext::takeMessage() const {
    return std::exchange(*m_message, {});
}

const ProjContext& threadProjContext() {
    thread_local const ProjContext context;
    return context;
}

}  // namespace reflet
