// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/CubeDirection.h"

#include <algorithm>

namespace reflet {

namespace {

/// The texel beyond the edge of a face that lies next to (column, row), one of which is -1 or
/// resolution: the one on the neighbouring face that shares the edge. The middle of the shared
/// edge belongs to both faces; its direction, read on the other face, gives column and row.
Texel acrossEdge(int resolution, int face, int column, int row) {
    const bool beyondColumn = column < 0 || column >= resolution;
    const double s = beyondColumn ? (column < 0 ? -1.0 : 1.0) : texelCoordinate(resolution, column);
    const double t = beyondColumn ? texelCoordinate(resolution, row) : (row < 0 ? -1.0 : 1.0);
    const glm::dvec3 onEdge = faceDirection(face, {s, t});
    // Two components are ±1; the one that is not this face's axis is the neighbour's.
    glm::dvec3 towards = onEdge - faceAxis(face);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(towards[axis]) < 1.0)
            towards[axis] = 0.0;
    }
    const int neighbour = facePoint(towards).face;
    // The neighbour's own (s, t): the inverse of faceDirection, without the tie rule.
    const glm::dvec3 base = faceDirection(neighbour, {0.0, 0.0});
    const glm::dvec3 sAxis = faceDirection(neighbour, {1.0, 0.0}) - base;
    const glm::dvec3 tAxis = faceDirection(neighbour, {0.0, 1.0}) - base;
    const auto index = [&](const glm::dvec3& axis) {
        const double along = axis.x * onEdge.x + axis.y * onEdge.y + axis.z * onEdge.z;
        return std::clamp(int(std::floor((along + 1.0) * 0.5 * resolution)), 0, resolution - 1);
    };
    return {neighbour, index(sAxis), index(tAxis)};
}

/// Solid angle of the rectangle between the face's centre and (x, y) on the plane at distance 1.
double cornerSolidAngle(double x, double y) {
    return std::atan2(x * y, std::sqrt(x * x + y * y + 1.0));
}

struct Axis {
    int first = 0;          ///< -1 .. resolution - 1; the second texel is the next
    float fraction = 0.0f;  ///< weight of the second
};

Axis axisAt(int resolution, double coordinate) {
    const double position = (coordinate + 1.0) * 0.5 * resolution - 0.5;
    const double first = std::floor(position);
    return {int(first), float(position - first)};
}

/// All four texels lie on the face itself.
bool insideFace(int resolution, const Axis& s, const Axis& t) {
    return s.first >= 0 && t.first >= 0 && s.first + 1 < resolution && t.first + 1 < resolution;
}

}  // namespace

glm::dvec3 faceAxis(int face) {
    glm::dvec3 axis(0.0);
    axis[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
    return axis;
}

double texelSolidAngle(int resolution, int column, int row) {
    const double x0 = 2.0 * column / resolution - 1.0;
    const double x1 = 2.0 * (column + 1) / resolution - 1.0;
    const double y0 = 2.0 * row / resolution - 1.0;
    const double y1 = 2.0 * (row + 1) / resolution - 1.0;
    return cornerSolidAngle(x1, y1) - cornerSolidAngle(x0, y1) - cornerSolidAngle(x1, y0) +
           cornerSolidAngle(x0, y0);
}

Texel texelAt(int resolution, const glm::dvec3& direction) {
    const FacePoint point = facePoint(direction);
    const auto index = [&](double coordinate) {
        return std::min(int((coordinate + 1.0) * 0.5 * resolution), resolution - 1);
    };
    return {point.face, index(point.st.x), index(point.st.y)};
}

BilinearFootprint bilinearFootprint(int resolution, const FacePoint& point) {
    const Axis s = axisAt(resolution, point.st.x);
    const Axis t = axisAt(resolution, point.st.y);
    BilinearFootprint result;
    if (insideFace(resolution, s, t)) {
        const int column = s.first;
        const int row = t.first;
        result.texel = {Texel{point.face, column, row}, Texel{point.face, column + 1, row},
                        Texel{point.face, column, row + 1}, Texel{point.face, column + 1, row + 1}};
        result.weight = {(1.0f - s.fraction) * (1.0f - t.fraction),
                         s.fraction * (1.0f - t.fraction), (1.0f - s.fraction) * t.fraction,
                         s.fraction * t.fraction};
        return result;
    }
    int missing = -1;
    for (int k = 0; k < 4; ++k) {
        const int column = s.first + (k & 1);
        const int row = t.first + (k >> 1);
        const bool columnInside = column >= 0 && column < resolution;
        const bool rowInside = row >= 0 && row < resolution;
        const auto slot = std::size_t(k);
        result.weight[slot] = ((k & 1) != 0 ? s.fraction : 1.0f - s.fraction) *
                              ((k >> 1) != 0 ? t.fraction : 1.0f - t.fraction);
        if (columnInside && rowInside) {
            result.texel[slot] = {point.face, column, row};
        } else if (columnInside || rowInside) {
            result.texel[slot] = acrossEdge(resolution, point.face, column, row);
        } else {
            missing = k;
        }
    }
    if (missing >= 0) {
        const auto gap = std::size_t(missing);
        const float share = result.weight[gap] / 3.0f;
        std::swap(result.texel[gap], result.texel[3]);
        std::swap(result.weight[gap], result.weight[3]);
        for (std::size_t k = 0; k < 3; ++k)
            result.weight[k] += share;
        result.texel[3] = result.texel[0];
        result.weight[3] = 0.0f;
    }
    return result;
}

BilinearFootprint bilinearFootprint(int resolution, const glm::dvec3& direction) {
    return bilinearFootprint(resolution, facePoint(direction));
}

glm::vec3 sampleBilinear(const CubeMap<glm::vec3>& map, const glm::dvec3& direction) {
    const int resolution = map.resolution();
    const FacePoint point = facePoint(direction);
    const Axis s = axisAt(resolution, point.st.x);
    const Axis t = axisAt(resolution, point.st.y);
    if (insideFace(resolution, s, t)) {
        const glm::vec3* upper = &map.at(point.face, s.first, t.first);
        const glm::vec3* lower = upper + resolution;
        const glm::vec3 above = upper[0] + s.fraction * (upper[1] - upper[0]);
        const glm::vec3 below = lower[0] + s.fraction * (lower[1] - lower[0]);
        return above + t.fraction * (below - above);
    }
    const BilinearFootprint footprint = bilinearFootprint(resolution, point);
    glm::vec3 sum(0.0f);
    for (std::size_t k = 0; k < 4; ++k) {
        const Texel& texel = footprint.texel[k];
        sum += footprint.weight[k] * map.at(texel.face, texel.column, texel.row);
    }
    return sum;
}

}  // namespace reflet
