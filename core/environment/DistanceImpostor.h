// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"

#include <glm/vec3.hpp>

namespace reflet {

/// The direction in which an environment map shows what a ray meets that starts beside the map's
/// centre: the ray is followed through the surface that the map's own distances describe
/// (Szirmay-Kalos, Aszódi, Lazányi, Premecz 2005, Approximate Ray-Tracing on the GPU with Distance
/// Impostors). 1/z is linear on planes, and so is the test along the ray: hits on planes are exact
/// up to the map's interpolation.
///
/// Where the ray meets what the centre does not see, it ends at the edge that hides it. A surface
/// that the ray passes by between two of the eight places that are looked at is missed.
///
/// distance: metres from the centre, +infinity for sky; not empty. origin: from the centre; nearer
/// to it than any surface in that direction, else it counts as at the surface. direction: unit.
/// The answer is of any length; `direction` itself for sky, and where origin is the centre.
[[nodiscard]] glm::vec3 directionOfHit(const CubeMap<float>& distance, const glm::vec3& origin,
                                       const glm::vec3& direction);

}  // namespace reflet
