// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/Facade.h"

namespace reflet {

/// The procedural look of everything but façades: roofs, roads, paving, grass, water, trees. Fixed
/// to the world, averaged over the footprint, a function of the surface point alone.
[[nodiscard]] glm::vec3 patternColour(const SurfaceLook& look, const BuildingLook& building,
                                      const glm::vec3& point, const glm::vec3& normal,
                                      const Footprint& footprint);

}  // namespace reflet
