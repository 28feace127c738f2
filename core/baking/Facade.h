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

/// The measures and colours of one building's façades.
struct FacadeStyle {
    bool modern = false;
    bool shops = false;
    bool awnings = false;
    bool shutters = false;
    bool rusticated = false;
    bool stringCourses = false;
    float groundStorey = 3.2F;
    float storey = 3.2F;
    float bay = 3.0F;
    float window = 1.15F;  ///< width of an opening
    float height = 1.75F;
    float sill = 0.85F;  ///< above the storey's floor
    float surround = 0.13F;
    float frame = 0.07F;
    glm::vec3 wall{0.7F};
    glm::vec3 trim{0.8F};
    glm::vec3 frameColour{0.75F};
    glm::vec3 shutter{0.2F};
    glm::vec3 plinth{0.4F};
};

/// The pattern of bays and storeys on one wall; heights above the building's base, counts of
/// storeys from the floor above the ground storey.
struct FacadeGrid {
    float margin = 0.0F;  ///< metres from the wall's start to the first bay
    float bay = 3.0F;
    float firstBay = -1e5F, lastBay = 1e5F;       ///< windows stand in [first, last)
    float firstStorey = 0.0F, lastStorey = 0.0F;  ///< of windows above the ground storey
    float firstGround = 0.0F, lastGround = 0.0F;  ///< 0 and 1 where the ground storey has some
    float courses = 0.0F;                         ///< string courses
    float doorBay = -1e6F;                        ///< of a ground storey without shops
};

/// Chosen by the building's seed, tinted by the surface's colour.
[[nodiscard]] FacadeStyle facadeStyle(const SurfaceLook& look, const BuildingLook& building);
[[nodiscard]] glm::vec3 doorColour(const BuildingLook& building);
[[nodiscard]] FacadeGrid facadeGrid(const SurfaceLook& look, const BuildingLook& building,
                                    const FacadeStyle& style);

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
