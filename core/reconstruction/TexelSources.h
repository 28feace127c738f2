// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace reflet {

/// Where the radiance of a texel was looked up.
struct TexelSource {
    std::int32_t rem = -1;   ///< index into the RemSet; -1 = nowhere
    float weight = 0.0F;     ///< 0..1
    glm::vec3 lookup{0.0F};  ///< direction from the REM's centre, of any length
};

/// The two heaviest sources of each texel of a local map, heaviest first. More can share in texels
/// of a quad whose corners are served by several REMs.
using TexelSources = CubeMap<std::array<TexelSource, 2>>;

}  // namespace reflet
