// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/TriangleRaster.h"

#include <cstdint>
#include <optional>

namespace reflet {

/// How a vertical line meets a triangle. A line through an edge or a corner is decided as eight
/// lines beside it are, infinitely near, in the directions east, north, west and south, each a
/// little to the left and to the right: of a closed shell each of them crosses as many surfaces
/// that face up as surfaces that face down. The decision is exact.
struct CenterCrossing {
    double z = 0.0;           ///< within the heights of the triangle's corners
    std::uint8_t beside = 0;  ///< bit k: the line beside it in direction k meets the triangle
    std::int8_t facing = 0;   ///< +1 up, -1 down
};
inline constexpr std::uint8_t kAllBeside = 0xff;

/// Nothing when the line does not touch the closed triangle, nor for upright triangles (which have
/// no inside when seen from above).
[[nodiscard]] std::optional<CenterCrossing> crossingAt(const TriangleCorners& triangle, double x,
                                                       double y);

}  // namespace reflet
