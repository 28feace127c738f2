// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TrianglePieces.h"

#include <algorithm>

namespace reflet {

namespace {

/// cos(89.9 degrees)²: above it a surface has a height at a point.
constexpr double kSteepestCosineSquared = 0.0017453 * 0.0017453;

bool isWall(const TriangleCorners& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    return normal.z * normal.z <= kSteepestCosineSquared * glm::dot(normal, normal);
}

}  // namespace

void raiseCenters(RisingLayer& layer, const GridPlan& plan, const TriangleCorners& triangle,
                  CellRange rows) {
    if (isWall(triangle)) {
        return;
    }
    const auto [a, b, c] = triangle;
    const auto [low, high] = std::minmax({a.z, b.z, c.z});
    const double orientation = side(a, b, c.x, c.y) < 0.0 ? -1.0 : 1.0;
    for (int j = rows.first; j < rows.last; ++j) {
        const double y = plan.rows.center[std::size_t(j)];
        const auto [from, to] = rangeAlong(triangle, y);
        if (!(from <= to)) {
            continue;
        }
        const CellRange range = touchedCells(plan.columns, from, to);
        for (int i = range.first; i < range.last; ++i) {
            const double x = plan.columns.center[std::size_t(i)];
            const double wa = orientation * side(b, c, x, y);
            const double wb = orientation * side(c, a, x, y);
            const double wc = orientation * side(a, b, x, y);
            const double sum = wa + wb + wc;
            if (wa >= 0.0 && wb >= 0.0 && wc >= 0.0 && sum > 0.0) {
                const double z = (wa * a.z + wb * b.z + wc * c.z) / sum;
                layer.raise(i, j, float(std::clamp(z, low, high)));
            }
        }
    }
}

}  // namespace reflet
