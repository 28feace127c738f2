// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TriangleRaster.h"

#include "core/heightfield/RowProfile.h"

#include <tuple>

namespace reflet {

namespace {

/// cos(89.9 degrees)²: above it a surface has a height at a point.
constexpr double kSteepestCosineSquared = 0.0017453 * 0.0017453;

bool isWall(const TriangleCorners& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    return normal.z * normal.z <= kSteepestCosineSquared * glm::dot(normal, normal);
}

/// A triangle's plane over the points that it covers.
class CoveredPoints {
public:
    explicit CoveredPoints(const TriangleCorners& t)
        : m_z{t[0].z, t[1].z, t[2].z}, m_side{{{t[1], t[2]}, {t[2], t[0]}, {t[0], t[1]}}} {
        std::tie(m_low, m_high) = std::minmax({t[0].z, t[1].z, t[2].z});
        if (m_side[2](t[2].x, t[2].y) < 0.0) {
            for (EdgeSide& side : m_side)
                side.turn();
        }
    }

    /// Calls use(z) if the point is covered.
    template <class Use>
    void at(double x, double y, const Use& use) const {
        const double a = m_side[0](x, y);
        const double b = m_side[1](x, y);
        const double c = m_side[2](x, y);
        const double sum = a + b + c;
        if (std::min({a, b, c}) >= 0.0 && sum > 0.0)
            use(float(std::clamp((a * m_z[0] + b * m_z[1] + c * m_z[2]) / sum, m_low, m_high)));
    }

private:
    std::array<double, 3> m_z;
    std::array<EdgeSide, 3> m_side;
    double m_low, m_high;
};

}  // namespace

void raiseMaximum(RisingLayer& layer, const GridPlan& plan, const TriangleCorners& triangle,
                  CellRange rows) {
    visitRows(plan, triangle, rows, [&](int j, const ProfilePoints& points) {
        const UpperProfile profile(points);
        const float highest = roundedUp(profile.highest());
        const CellRange range = touchedCells(plan.columns, profile.west(), profile.east());
        for (int i = range.first; i < range.last; ++i) {
            if (layer.at(i, j) < highest) {
                const auto n = std::size_t(i);
                const auto& border = plan.columns.border;
                layer.raise(i, j, roundedUp(profile.highest(border[n], border[n + 1])));
            }
        }
    });
}

void raiseCenters(RisingLayer& layer, RisingLayer* second, const GridPlan& plan,
                  const TriangleCorners& triangle, CellRange rows) {
    if (isWall(triangle))
        return;
    const CoveredPoints covered(triangle);
    const TriangleCuts cuts(triangle);
    for (int j = rows.first; j < rows.last; ++j) {
        const double y = plan.rows.center[std::size_t(j)];
        const auto [from, to] = cuts.range(y);
        if (!(from <= to))
            continue;
        const CellRange range = touchedCells(plan.columns, from, to);
        for (int i = range.first; i < range.last; ++i) {
            covered.at(plan.columns.center[std::size_t(i)], y, [&](float z) {
                layer.raise(i, j, z);
                if (second != nullptr)
                    second->raise(i, j, z);
            });
        }
    }
}

}  // namespace reflet
