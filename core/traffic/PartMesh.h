// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace reflet {

/// A part of a vehicle while it is being modelled, in the body's frame (x forward, y left, z up,
/// metres). Triangles are counter-clockwise seen from outside.
struct PartMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< unit, one per position
    /// Where a vertex lies on the surface that it was made from, in metres where that makes sense
    /// (unrolled length along a shell, height): regions may be drawn in these coordinates.
    std::vector<glm::vec2> surface;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint16_t> material;  ///< one per triangle
};

struct GridPoint {
    glm::vec3 position{0.0F};
    glm::vec2 surface{0.0F};
};

/// A surface sampled on rows × columns points. Outside is where (along a row) × (along a column)
/// points: d/dcolumn × d/drow. `ring`: the last column joins the first. Rows and columns that
/// collapse to a point or a line leave no degenerate triangles. Normals are smooth up to `crease`.
[[nodiscard]] PartMesh gridSurface(int rows, int columns, bool ring, std::uint16_t material,
                                   float crease,
                                   const std::function<GridPoint(int row, int column)>& point);

/// Vertex normals as the angle-weighted mean of the triangles around a position that lie within
/// `crease` radians of each other; vertices are merged and split to suit. Degenerate triangles go.
void smoothNormals(PartMesh& mesh, float crease);

void append(PartMesh& mesh, const PartMesh& other);
[[nodiscard]] PartMesh moved(PartMesh mesh, const glm::vec3& by);
/// rotation must be orthonormal with determinant +1.
[[nodiscard]] PartMesh turned(PartMesh mesh, const glm::mat3& rotation);
/// Mirrored at the plane y = 0, still facing outwards.
[[nodiscard]] PartMesh mirroredLeftRight(PartMesh mesh);
/// Turned by half a turn about z: a front becomes a rear.
[[nodiscard]] PartMesh turnedAround(PartMesh mesh);
/// Turns all triangles over when the enclosed volume is negative.
void faceOutwards(PartMesh& mesh);

}  // namespace reflet
