// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/PhotoMesh.h"

#include <algorithm>
#include <cmath>

namespace reflet::importers {

bool isSkinOverGround(const std::vector<glm::dvec3>& vertices,
                      const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    constexpr double kNarrowest = 60.0;  // metres
    constexpr double kCovered = 0.65, kFromBelow = 0.2;
    Box box;
    double above = 0.0, below = 0.0;
    for (const auto& t : triangles) {
        const glm::dvec3 &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
        const double area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        if (!std::isfinite(area + a.z + b.z + c.z))
            continue;
        (area > 0.0 ? above : below) += std::abs(area);
        box.add(a);
        box.add(b);
        box.add(c);
    }
    const glm::dvec3 size = box.size();
    return std::min(size.x, size.y) >= kNarrowest && above >= kCovered * size.x * size.y &&
           below <= kFromBelow * above;
}

}  // namespace reflet::importers
