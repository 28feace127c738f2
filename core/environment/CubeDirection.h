// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cassert>
#include <cmath>

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
/// (s, t) may lie outside [-1, 1]²: the face's plane goes on.
[[nodiscard]] inline glm::dvec3 faceDirection(int face, const glm::dvec2& st) {
    switch (face) {
        case 0:
            return {1.0, -st.y, -st.x};
        case 1:
            return {-1.0, -st.y, st.x};
        case 2:
            return {st.x, 1.0, st.y};
        case 3:
            return {st.x, -1.0, -st.y};
        case 4:
            return {st.x, -st.y, 1.0};
        default:
            return {-st.x, -st.y, -1.0};
    }
}

/// The face that a direction (any length but zero) meets, and where. Ties go to x, then y.
/// Exact for directions that are scaled to 1 along the face's axis.
[[nodiscard]] inline FacePoint facePoint(const glm::dvec3& direction) {
    const double ax = std::abs(direction.x);
    const double ay = std::abs(direction.y);
    const double az = std::abs(direction.z);
    assert(ax + ay + az > 0.0 && "a direction is neither zero nor NaN");
    if (ax >= ay && ax >= az) {
        const double s = direction.x > 0.0 ? -direction.z : direction.z;
        return {direction.x > 0.0 ? 0 : 1, {s / ax, -direction.y / ax}};
    }
    if (ay >= az) {
        const double t = direction.y > 0.0 ? direction.z : -direction.z;
        return {direction.y > 0.0 ? 2 : 3, {direction.x / ay, t / ay}};
    }
    const double s = direction.z > 0.0 ? direction.x : -direction.x;
    return {direction.z > 0.0 ? 4 : 5, {s / az, -direction.y / az}};
}

/// The outward axis of a face.
[[nodiscard]] glm::dvec3 faceAxis(int face);

/// s of a column's centre, or t of a row's centre, in (-1, 1).
[[nodiscard]] inline double texelCoordinate(int resolution, int index) {
    return double(2 * index + 1) / double(resolution) - 1.0;
}

/// Direction (scaled to 1 along the face's axis) through a texel's centre.
[[nodiscard]] inline glm::dvec3 texelDirection(int resolution, int face, int column, int row) {
    return faceDirection(face,
                         {texelCoordinate(resolution, column), texelCoordinate(resolution, row)});
}

/// Solid angle of a texel in steradians; all texels of a cube map add up to 4π.
[[nodiscard]] double texelSolidAngle(int resolution, int column, int row);

struct Texel {
    int face = 0, column = 0, row = 0;
    friend bool operator==(const Texel&, const Texel&) = default;
};
/// The texel whose square contains the direction (half-open towards larger columns and rows; the
/// last of each face is closed).
[[nodiscard]] Texel texelAt(int resolution, const glm::dvec3& direction);

/// The four texels around a direction, with bilinear weights (sum 1); across an edge of the cube
/// they come from the neighbouring face, so that lookups have no seams. At a corner of the cube
/// only three texels meet: the place of the fourth takes their mean (as GL 4.5 core, 8.14.1,
/// allows), so texel[3] repeats one of the others with weight 0.
struct BilinearFootprint {
    std::array<Texel, 4> texel;
    std::array<float, 4> weight;
};
[[nodiscard]] BilinearFootprint bilinearFootprint(int resolution, const glm::dvec3& direction);
[[nodiscard]] BilinearFootprint bilinearFootprint(int resolution, const FacePoint& point);

/// Bilinear lookup without seams. The map must not be empty.
[[nodiscard]] glm::vec3 sampleBilinear(const CubeMap<glm::vec3>& map, const glm::dvec3& direction);

}  // namespace reflet
