// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/Pattern.h"
#include "core/baking/SurfaceLook.h"

namespace reflet {

/// What a surface sends back of the light that meets it, and what it sends out of its own.
struct Appearance {
    glm::vec3 albedo{0.5F};
    glm::vec3 emission{0.0F};
};

/// Tells whether a rectangle of a wall (along the tangent from..to in metres of the look's uMin,
/// heights in z) lies wholly on the surface.
using WallContains = bool (*)(const void* wall, float u0, float u1, float z0, float z1);

/// A procedural façade at a point of a wall: storeys of about 3.2 m from the building's base, bays
/// of about 3 m, windows with surrounds, sills and curtains, shutters, shops and a cornice, chosen
/// by the building's seed. It depends on the point alone, averaged over the footprint: each part is
/// a product of two pulse trains whose box filter is exact. night: 0 by day, 1 at night (lit
/// windows). `contains` keeps windows off the slopes of gables; null for rectangular walls.
[[nodiscard]] Appearance facadeAppearance(const SurfaceLook& look, const BuildingLook& building,
                                          const glm::vec3& point, const Footprint& footprint,
                                          float night, WallContains contains, const void* wall);

/// The mean colour of such a façade, for the light that it throws on others.
[[nodiscard]] glm::vec3 facadeMean(const SurfaceLook& look);

}  // namespace reflet
