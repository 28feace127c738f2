// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace reflet {

/// A vertex of a vehicle's body as the GPU has it; the material belongs to the vertex.
struct BodyVertex {
    glm::vec3 position{0.0F};  ///< body frame
    glm::vec3 normal{0.0F};
    std::uint32_t material = 0;
};

/// Triangles of a body: first those of opaque materials, then those of glass.
struct BodyMesh {
    std::vector<BodyVertex> vertices;
    std::vector<std::uint32_t> opaque, glass;  ///< three indices a triangle
};

/// The same body, coarser: vertices of one cell of a grid (edge in metres) come to lie in one place
/// (clustering, Rossignac and Borrel 1993), and triangles that lose their area that way are left
/// out. No vertex moves by more than the cell's diagonal, and what was joined stays joined: no
/// cracks. Vertices keep apart that differ in material or face different ways, so that creases stay
/// sharp.
[[nodiscard]] BodyMesh clustered(const BodyMesh& mesh, float cell);

/// The same body with fewer triangles: clustered, and then flat and evenly curved places thinned
/// out (Garland and Heckbert 1997, by meshoptimizer) until surfaces would move by about `error`
/// metres once more. Nothing is left of what is smaller than that. Same order of materials.
[[nodiscard]] BodyMesh coarser(const BodyMesh& mesh, float error);

}  // namespace reflet
