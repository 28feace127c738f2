// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/SurfaceRefinement.h"

#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

/// How far four values of 1/z may be from a plane, relative to their mean.
constexpr double kFlatness = 0.01;
constexpr int kSteps = 2;

/// n of the plane {C + x : n·x = 1} through the surface around a direction.
std::optional<glm::dvec3> planeAround(const CubeMap<float>& distance, const glm::dvec3& direction) {
    const int n = distance.resolution();
    if (n < 2) {
        return std::nullopt;
    }
    const FacePoint point = facePoint(direction);
    const auto firstOf = [n](double coordinate) {
        return std::clamp(int(std::floor((coordinate + 1.0) * 0.5 * n - 0.5)), 0, n - 2);
    };
    const int column = firstOf(point.st.x);
    const int row = firstOf(point.st.y);
    double inverseDepth[4];
    for (int k = 0; k < 4; ++k) {
        const int i = column + (k & 1);
        const int j = row + (k >> 1);
        inverseDepth[k] = glm::length(texelDirection(n, point.face, i, j)) /
                          double(distance.at(point.face, i, j));
    }
    const double sum = inverseDepth[0] + inverseDepth[1] + inverseDepth[2] + inverseDepth[3];
    const double twist = inverseDepth[0] - inverseDepth[1] - inverseDepth[2] + inverseDepth[3];
    if (!(sum > 0.0) || !(std::abs(twist) <= kFlatness * 0.25 * sum)) {
        return std::nullopt;
    }
    // 1/z = c + a s + b t; with the major component 1/(n·d) = z this is n·d for d = d(s, t).
    const double perTexel = 0.25 * n;  // half the difference of two pairs, over 2/n
    const double a =
        perTexel * (inverseDepth[1] + inverseDepth[3] - inverseDepth[0] - inverseDepth[2]);
    const double b =
        perTexel * (inverseDepth[2] + inverseDepth[3] - inverseDepth[0] - inverseDepth[1]);
    const double c =
        0.25 * sum - a * (2.0 * (column + 1) / n - 1.0) - b * (2.0 * (row + 1) / n - 1.0);
    const glm::dvec3 axis = faceAxis(point.face);
    const glm::dvec3 sAxis = faceDirection(point.face, {1.0, 0.0}) - axis;
    const glm::dvec3 tAxis = faceDirection(point.face, {0.0, 1.0}) - axis;
    return c * axis + a * sAxis + b * tAxis;
}

}  // namespace

std::optional<double> refineOnSurface(const ReferenceEnvironmentMap& rem, const Ray& ray,
                                      double hit, double reach) {
    double t = hit;
    const double limit = reach / glm::length(ray.direction);
    for (int step = 0; step < kSteps; ++step) {
        const glm::dvec3 fromCenter = ray.at(t) - rem.center;
        if (fromCenter == glm::dvec3(0.0)) {
            return std::nullopt;
        }
        const std::optional<glm::dvec3> plane = planeAround(rem.distance, fromCenter);
        if (!plane) {
            return std::nullopt;
        }
        const double towards = glm::dot(*plane, ray.direction);
        t = (1.0 - glm::dot(*plane, ray.origin - rem.center)) / towards;
        if (!(t > 0.0 && std::abs(t - hit) <= limit)) {
            return std::nullopt;
        }
    }
    return t;
}

}  // namespace reflet
