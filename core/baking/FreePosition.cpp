// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/EnvironmentBaker.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace reflet {

namespace {

constexpr double kReach = 10.0;  ///< metres that a position may be moved
constexpr double kStep = 0.5;
constexpr int kAround = 24;           ///< places on a ring
constexpr double kAboveGround = 0.5;  ///< least height over the ground
constexpr float kClearance = 0.25F;   ///< least distance from any surface

double groundBelow(const Heightfield* ground, const glm::dvec3& p) {
    return ground != nullptr ? double(ground->groundAt(p.x, p.y)) : double(kMissingHeight);
}

bool hasClearance(const RadianceScene& scene, const glm::vec3& p) {
    constexpr std::array<glm::vec3, 6> axes{glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0),
                                            glm::vec3(0, 1, 0), glm::vec3(0, -1, 0),
                                            glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)};
    return std::none_of(axes.begin(), axes.end(),
                        [&](const glm::vec3& axis) { return scene.occluded(p, axis, kClearance); });
}

bool isFree(const RadianceScene& scene, const Heightfield* ground, const glm::dvec3& p) {
    const double floor = groundBelow(ground, p);
    return !(p.z < floor + kAboveGround) && !scene.insideSolid(glm::vec3(p)) &&
           hasClearance(scene, glm::vec3(p));
}

}  // namespace

std::optional<glm::dvec3> nearestFreePosition(const RadianceScene& scene, const Heightfield* ground,
                                              const glm::dvec3& position) {
    if (isFree(scene, ground, position)) {
        return position;
    }
    // From below the ground the way is up, out of it; the search goes on from there.
    glm::dvec3 start = position;
    if (const double floor = groundBelow(ground, position); position.z < floor + kAboveGround) {
        start.z = floor + kAboveGround;
        if (isFree(scene, ground, start)) {
            return start;
        }
    }
    const double height = start.z - groundBelow(ground, start);
    for (double distance = kStep; distance <= kReach; distance += kStep) {
        const glm::dvec3 above = start + glm::dvec3(0.0, 0.0, distance);
        if (isFree(scene, ground, above)) {
            return above;
        }
        for (int i = 0; i < kAround; ++i) {
            const double azimuth = 2.0 * kPi * i / kAround;
            glm::dvec3 beside =
                start + distance * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.0);
            // The height over the ground stays, where there is one.
            const double floor = groundBelow(ground, beside);
            if (std::isfinite(floor) && std::isfinite(height)) {
                beside.z = floor + height;
            }
            if (isFree(scene, ground, beside)) {
                return beside;
            }
        }
    }
    return std::nullopt;
}

}  // namespace reflet
