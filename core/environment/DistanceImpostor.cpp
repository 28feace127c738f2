// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/DistanceImpostor.h"

#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>

#include <cassert>
#include <cmath>

namespace reflet {

namespace {

constexpr int kPlaces = 8;          // along the ray, at even steps of about its angle
constexpr int kSecants = 3;         // of the bracket that they find
constexpr float kAtCenter = 1e-4F;  // metres

/// 1/distance in a direction, interpolated; 0 for sky.
float nearness(const CubeMap<float>& distance, const glm::vec3& direction) {
    const BilinearFootprint print = bilinearFootprint(distance.resolution(), glm::dvec3(direction));
    float sum = 0.0F;
    for (std::size_t k = 0; k < print.texel.size(); ++k) {
        const Texel& t = print.texel[k];
        sum += print.weight[k] / distance.at(t.face, t.column, t.row);
    }
    return sum;
}

}  // namespace

glm::vec3 directionOfHit(const CubeMap<float>& distance, const glm::vec3& origin,
                         const glm::vec3& direction) {
    assert(!distance.empty());
    const float away = glm::length(origin);
    if (!(away > kAtCenter))
        return direction;
    // How far behind the surface a point of the ray lies: below 0 in front of it.
    const auto behind = [&](float along) {
        const glm::vec3 p = origin + along * direction;
        return glm::length(p) * nearness(distance, p) - 1.0F;
    };
    float from = 0.0F;
    float before = behind(0.0F);
    if (!(before < 0.0F))
        return origin;
    for (int k = 1; k <= kPlaces; ++k) {
        float to = 0.0F;
        if (k < kPlaces) {
            to = away * float(k) / float(kPlaces - k);
        } else {
            // The rest of the ray: as far as its own direction sees, with room for the origin.
            const float far = nearness(distance, direction);
            if (!(far > 0.0F))
                return direction;
            to = from + away + 1.0F / far;
        }
        float after = behind(to);
        if (after < 0.0F) {
            from = to;
            before = after;
            continue;
        }
        for (int step = 0; step < kSecants && after > before; ++step) {
            const float middle = from - before * (to - from) / (after - before);
            const float there = behind(middle);
            if (there < 0.0F) {
                from = middle;
                before = there;
            } else {
                to = middle;
                after = there;
            }
        }
        const float hit = after > before ? from - before * (to - from) / (after - before) : to;
        return origin + hit * direction;
    }
    return origin + from * direction;
}

}  // namespace reflet
