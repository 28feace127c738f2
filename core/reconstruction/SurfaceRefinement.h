// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/EnvironmentMap.h"

#include <optional>

namespace reflet {

/// Moves a hit of the heightfield onto the surface that a REM saw there. A heightfield knows a wall
/// only as a staircase of cells; the REM's distances were taken from the city itself.
///
/// Around the direction C→I, four neighbouring distances tell the plane of the surface: on a plane
/// 1/z is affine in the face's (s, t). Returns the ray's parameter on that plane, or nothing when
/// the four do not lie on one plane (an edge), or when it is farther than `reach` metres from the
/// hit: then the REM sees something else there.
[[nodiscard]] std::optional<double> refineOnSurface(const ReferenceEnvironmentMap& rem,
                                                    const Ray& ray, double hit, double reach);

}  // namespace reflet
