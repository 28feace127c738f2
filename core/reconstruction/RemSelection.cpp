// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/Reconstruction.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

double squaredDistance(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = a - b;
    return glm::dot(d, d);
}

/// The nearest REM for which accept(index) holds; equal distances go by id, equal ids by index.
template <class Accept>
std::optional<std::size_t> nearestRem(const RemSet& rems, const glm::dvec3& position,
                                      const Accept& accept) {
    std::optional<std::size_t> best;
    double bestDistance = 0.0;
    for (std::size_t i = 0; i < rems.size(); ++i) {
        if (!accept(i))
            continue;
        const double distance = squaredDistance(rems[i].center, position);
        const bool nearer = !best || distance < bestDistance ||
                            (distance == bestDistance && rems[i].id < rems[*best].id);
        if (nearer) {
            best = i;
            bestDistance = distance;
        }
    }
    return best;
}

/// The largest of the four distances around a direction, as far as they count in a lookup.
float largestDistance(const CubeMap<float>& distance, const glm::dvec3& direction) {
    const BilinearFootprint footprint = bilinearFootprint(distance.resolution(), direction);
    float largest = -std::numeric_limits<float>::infinity();
    for (const Texel& texel : footprint.texel) {
        largest = std::max(largest, distance.at(texel.face, texel.column, texel.row));
    }
    return largest;
}

}  // namespace

RemChoice chooseRems(const RemSet& rems, const glm::dvec3& position) {
    RemChoice choice;
    choice.a = nearestRem(rems, position, [](std::size_t) { return true; });
    if (!choice.a)
        return choice;
    const std::size_t a = *choice.a;
    const glm::dvec3 towardsA = rems[a].center - position;
    choice.b = nearestRem(rems, position, [&](std::size_t i) {
        return i != a && glm::dot(towardsA, rems[i].center - position) < 0.0;
    });
    if (!choice.b)
        choice.b = nearestRem(rems, position, [&](std::size_t i) { return i != a; });
    return choice;
}

double blendParameter(const glm::dvec3& centerA, const glm::dvec3& centerB,
                      const glm::dvec3& point) {
    const glm::dvec3 axis = centerB - centerA;
    const double squaredLength = glm::dot(axis, axis);
    if (!(squaredLength > 0.0))
        return 0.0;
    return std::clamp(glm::dot(point - centerA, axis) / squaredLength, 0.0, 1.0);
}

bool isValid(const ReferenceEnvironmentMap& rem, const glm::dvec3& point, double epsilon) {
    const glm::dvec3 direction = point - rem.center;
    const double distance = glm::length(direction);
    if (!(distance > epsilon))
        return true;
    return double(largestDistance(rem.distance, direction)) >= distance - epsilon;
}

bool isValidSky(const ReferenceEnvironmentMap& rem, const glm::dvec3& direction) {
    return std::isinf(largestDistance(rem.distance, direction));
}

}  // namespace reflet
