// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TriangleRaster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace reflet {

namespace {

/// cos(89.9 degrees)²: above it a surface has a height at a point.
constexpr double kSteepestCosineSquared = 0.0017453 * 0.0017453;

bool isWall(const TriangleCorners& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    return normal.z * normal.z <= kSteepestCosineSquared * glm::dot(normal, normal);
}

/// Twice the signed area of (a, b, p), seen from above. Always computed from the edge's lesser
/// end, so that two triangles on either side of an edge get the same number with opposite signs:
/// no point between them can be outside of both.
double side(const glm::dvec3& a, const glm::dvec3& b, double x, double y) {
    const bool swapped = b.x < a.x || (b.x == a.x && b.y < a.y);
    const glm::dvec3& p = swapped ? b : a;
    const glm::dvec3& q = swapped ? a : b;
    const double area = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
    return swapped ? -area : area;
}

/// x range of a triangle along the line at y.
std::pair<double, double> rangeAlong(const TriangleCorners& t, double y) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t n = 0; n < 3; ++n) {
        const glm::dvec3& a = t[n];
        const glm::dvec3& b = t[(n + 1) % 3];
        if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y) {
            continue;
        }
        const double s = a.y == b.y ? 0.0 : (y - a.y) / (b.y - a.y);
        for (const double x : {a.x + s * (b.x - a.x), a.y == b.y ? b.x : a.x + s * (b.x - a.x)}) {
            low = std::min(low, x);
            high = std::max(high, x);
        }
    }
    return {low, high};
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
