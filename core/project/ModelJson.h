// SPDX-License-Identifier: GPL-3.0-or-later
// How a model is spelled in a project file. Internal to core/project.
#pragma once

#include "core/project/Project.h"

#include <optional>
#include <string_view>

namespace reflet {

inline constexpr double kSmallestModelScale = 0.001;
inline constexpr double kLargestModelScale = 1000.0;

[[nodiscard]] inline const char* useText(ModelUse use) {
    switch (use) {
        case ModelUse::Terrain:
            return "terrain";
        case ModelUse::Orthophoto:
            return "ortho";
        case ModelUse::City:
            break;
    }
    return "city";
}

[[nodiscard]] inline std::optional<ModelUse> useFromText(std::string_view text) {
    for (const ModelUse use : {ModelUse::City, ModelUse::Terrain, ModelUse::Orthophoto})
        if (text == useText(use))
            return use;
    return std::nullopt;
}

}  // namespace reflet
