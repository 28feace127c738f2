// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/PartMesh.h"

#include <functional>

namespace reflet {

/// A point of a part, as regions see it.
struct SurfacePoint {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F};
    glm::vec2 surface{0.0F};
};

/// A region drawn on a surface: a signed distance in metres, negative inside, continuous. It need
/// not be exact away from the border.
using Region = std::function<float(const SurfacePoint&)>;

/// How windows, doors, lights and livery are drawn on a smooth shell: triangles are split along the
/// border of a region, so that the border is sharp while positions stay on the shell's facets and
/// normals are the shell's own, interpolated. Neighbours are split alike: no cracks, no
/// T-junctions. Triangles near a curved border are first refined until its chords err by under a
/// millimetre.
void cutAlong(PartMesh& mesh, const Region& region);

/// Gives the inside a material.
void paint(PartMesh& mesh, const Region& region, std::uint16_t material);
/// Gives a band of `width` metres centred on the border a material (gaskets, gaps between panels).
void outline(PartMesh& mesh, const Region& region, float width, std::uint16_t material);
/// Sinks the inside by `depth` metres against the normals; a band of `width` just inside the border
/// becomes the slope down (material `rim`), the rest gets `inner`.
void inset(PartMesh& mesh, const Region& region, float width, float depth, std::uint16_t rim,
           std::uint16_t inner);
/// Removes the inside.
void removeInside(PartMesh& mesh, const Region& region);
/// Parts with x < 0 and x >= 0.
struct SplitMesh {
    PartMesh rear;
    PartMesh front;
};
[[nodiscard]] SplitMesh splitAcross(PartMesh mesh);

}  // namespace reflet
