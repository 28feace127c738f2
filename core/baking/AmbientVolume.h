// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"

#include <array>
#include <memory>
#include <vector>

namespace reflet {

/// Soft light between the buildings on a coarse regular lattice: the sky where it is seen, and one
/// bounce of sun and sky where something stands in the way. For each node six values of irradiance
/// divided by pi, towards +x −x +y −y +z −z (an ambient cube: McTaggart 2004, Half-Life 2 / Valve
/// Source Shading); a surface takes the mean of those that it faces, weighted by the squares of its
/// normal's components.
struct AmbientVolume {
    glm::dvec3 origin{0.0};   ///< project frame, of node (0, 0, 0)
    glm::dvec3 spacing{4.0};  ///< metres between nodes
    int columns = 0, rows = 0, layers = 0;
    /// Six per node; index = ((layer · rows + row) · columns + column) · 6 + side.
    std::vector<glm::vec3> light;

    /// Irradiance / pi at a point (project frame) for a unit normal, trilinear, clamped outside.
    [[nodiscard]] glm::vec3 at(const glm::dvec3& point, const glm::vec3& normal) const;
};

/// Gathers the light of a scene; nodes inside solids take that of their nearest open neighbours.
/// The lattice has at most `maxNodes` nodes. Deterministic for any number of threads.
[[nodiscard]] Result<AmbientVolume> gatherAmbient(const RadianceScene& scene, std::size_t maxNodes,
                                                  const JobContext& job);

}  // namespace reflet
