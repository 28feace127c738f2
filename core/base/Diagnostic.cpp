// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Diagnostic.h"

namespace reflet {

const char* toString(Severity severity) {
    switch (severity) {
        case Severity::Info:
            return "info";
        case Severity::Warning:
            return "warning";
        case Severity::Error:
            return "error";
    }
    return "error";
}

}  // namespace reflet
