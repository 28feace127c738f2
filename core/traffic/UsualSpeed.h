// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace reflet {

/// Metres a second at which a vehicle of this name is put on a route: people walk, mirror trees
/// stand, all others drive.
[[nodiscard]] inline double usualSpeed(std::string_view vehicle) {
    if (vehicle == "woman" || vehicle == "man" || vehicle == "child")
        return 1.35;
    return vehicle == "mirror-tree" ? 0.0 : 8.0;
}

}  // namespace reflet
