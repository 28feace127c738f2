// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/VisibleBodies.h"

#include <algorithm>
#include <limits>

namespace reflet {

namespace {

glm::dvec3 corner(const Box& box, int k) {
    return {(k & 1) != 0 ? box.max.x : box.min.x, (k & 2) != 0 ? box.max.y : box.min.y,
            (k & 4) != 0 ? box.max.z : box.min.z};
}

}  // namespace

std::optional<ViewColumns> columnsOf(const Box& box, const RigidTransform& project_from_box,
                                     const CityView& view) {
    if (box.empty())
        return std::nullopt;
    bool left = true, right = true, below = true, above = true, behind = true, crosses = false;
    float from = std::numeric_limits<float>::max();
    float to = -from;
    float bottom = from;
    float top = to;
    for (int k = 0; k < 8; ++k) {
        const glm::vec3 d(project_from_box * corner(box, k) - view.eye);
        const float depth = glm::dot(d, view.forward);
        const float x = glm::dot(d, view.right) / view.tanHalf.x;
        const float y = glm::dot(d, view.up) / view.tanHalf.y;
        left = left && x < -depth;
        right = right && x > depth;
        below = below && y < -depth;
        above = above && y > depth;
        behind = behind && depth < view.near;
        crosses = crosses || depth < view.near;
        if (depth >= view.near) {
            from = std::min(from, x / depth);
            to = std::max(to, x / depth);
            bottom = std::min(bottom, y / depth);
            top = std::max(top, y / depth);
        }
    }
    if (left || right || below || above || behind)
        return std::nullopt;
    if (crosses)
        return ViewColumns{};
    const auto share = [](float at) { return std::clamp(0.5F + 0.5F * at, 0.0F, 1.0F); };
    return ViewColumns{share(from), share(to), share(bottom), share(top)};
}

Box placedBounds(const Box& box, const RigidTransform& project_from_box) {
    Box out;
    for (int k = 0; k < 8 && !box.empty(); ++k)
        out.add(project_from_box * corner(box, k));
    return out;
}

}  // namespace reflet
