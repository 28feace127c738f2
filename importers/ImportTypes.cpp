// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ImportTypes.h"

namespace reflet {

const char* toString(CrsRule rule) {
    switch (rule) {
        case CrsRule::Declared:
            return "declared";
        case CrsRule::Format:
            return "format";
        case CrsRule::Given:
            return "given";
        case CrsRule::Replaced:
            return "replaced";
        case CrsRule::Assumed:
            break;
    }
    return "assumed";
}

const char* toString(ObjectResult result) {
    switch (result) {
        case ObjectResult::Loaded:
            return "loaded";
        case ObjectResult::Repaired:
            return "repaired";
        case ObjectResult::Skipped:
            break;
    }
    return "skipped";
}

}  // namespace reflet
