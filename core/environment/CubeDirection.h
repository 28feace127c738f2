// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/environment/CubeMap.h"

namespace reflet {

/// The one place that knows which direction of the project frame belongs to which texel.
///
/// Faces and their axes are OpenGL's (GL 4.5 core, table 8.19), applied to project-frame vectors
/// as they are, so that a map can be bound as a samplerCube and looked up with project directions.
/// On a face, (s, t) in [-1, 1]² grow with column and row; texel centres lie at +0.5.
///   face   direction at (s, t)        face   direction at (s, t)
///   +X     ( 1, -t, -s)               -X     (-1, -t,  s)
///   +Y     ( s,  1,  t)               -Y     ( s, -1, -t)
///   +Z     ( s, -t,  1)               -Z     (-s, -t, -1)
struct FacePoint {
    int face = 0;
    glm::dvec2 st{0.0};  ///< in [-1, 1]² on the face
};

/// The direction at (s, t) of a face, scaled to 1 along the face's axis (|component| = 1).
[[nodiscard]] glm::dvec3 faceDirection(int face, const glm::dvec2& st);
/// The face that a direction (any length but zero) meets, and where. Ties go to x, then y.
[[nodiscard]] FacePoint facePoint(const glm::dvec3& direction);
/// The outward axis of a face.
[[nodiscard]] glm::dvec3 faceAxis(int face);
/// Direction (scaled to 1 along the face's axis) through a texel's centre.
[[nodiscard]] glm::dvec3 texelDirection(int resolution, int face, int column, int row);
/// Solid angle of a texel in steradians.
[[nodiscard]] double texelSolidAngle(int resolution, int column, int row);

struct Texel {
    int face = 0, column = 0, row = 0;
    friend bool operator==(const Texel&, const Texel&) = default;
};
/// The texel whose square contains the direction.
[[nodiscard]] Texel texelAt(int resolution, const glm::dvec3& direction);

/// The four texels around a direction, with bilinear weights (sum 1); across an edge of the cube
/// they come from the neighbouring face, so that lookups have no seams.
struct BilinearFootprint {
    std::array<Texel, 4> texel;
    std::array<float, 4> weight;
};
[[nodiscard]] BilinearFootprint bilinearFootprint(int resolution, const glm::dvec3& direction);

/// Bilinear lookup without seams.
[[nodiscard]] glm::vec3 sampleBilinear(const CubeMap<glm::vec3>& map, const glm::dvec3& direction);

}  // namespace reflet
