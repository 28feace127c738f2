// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"
#include "core/rendering/ViewRenderer.h"

#include <span>

namespace reflet {

/// Whether any part of a vehicle mirrors: those without need no local map.
[[nodiscard]] bool reflectsAnything(const Vehicle& vehicle);

/// Whether a body of these bounds (body frame) looks larger than a texel of a local map with
/// `resolution` texels along an edge, so that it must be drawn into it.
[[nodiscard]] bool fillsTexel(const Box& bounds, const RigidTransform& project_from_body,
                              const glm::dvec3& mapCenter, int resolution);

/// What vehicles are drawn with into local maps.
struct MapBodies {
    /// Made with the bodies as occluders, in the same order: their shadows and what is seen through
    /// their windows.
    const RadianceScene* scene = nullptr;
    /// `map` of each: what it mirrors itself, the city alone; null = rays.
    std::span<const PlacedBody> bodies;
    /// For the reference: the city without vehicles, which then decides with its own rays what is
    /// nearer. Null: the map's distances decide, as Meyer & Loscos 2003 (section 6) have it.
    const RadianceScene* city = nullptr;
    int samplesPerEdge = 2;  ///< this squared samples a texel
};

/// The second pass of DESIGN 5.3: draws the bodies of all vehicles but `reflector` into a local map
/// of one of its bodies, where they are nearer than what the map shows. A reflector's own bodies
/// are left out, neighbours in an articulated train too: they touch the body whose map this is, and
/// one centre cannot tell what a surface so near shows. Radiance is averaged over the samples;
/// distance is that along the texel's central ray. A mirrored vehicle mirrors the city, and no
/// third one. Returns the number of texels that show a vehicle. In parallel; the same bits for any
/// number of threads. Errors: as of RayScene::build().
[[nodiscard]] Result<std::size_t> drawIntoMap(LocalEnvironmentMap& map, std::size_t reflector,
                                              const MapBodies& bodies, const JobContext& job);

}  // namespace reflet
