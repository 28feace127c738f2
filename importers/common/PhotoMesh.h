// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <array>
#include <cstdint>
#include <vector>

namespace reflet::importers {

/// Whether a mesh is one skin over all that there is, as photogrammetry gives it, and not a set of
/// buildings: it is at least 60 m wide both ways, seen from above it covers two thirds of its
/// extent and more, and no second time from below. Metres, z up.
[[nodiscard]] bool isSkinOverGround(const std::vector<glm::dvec3>& vertices,
                                    const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace reflet::importers
