// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/CenterCrossing.h"

#include "core/heightfield/RowProfile.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

int signOf(double value) {
    return value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
}

/// The exact sign of twice the area of (a, b, p), seen from above. What rounding may decide (the
/// bound is Shewchuk's for three differences, two products and a sum) goes to CGAL.
int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    const double left = (b.x - a.x) * (p.y - a.y);
    const double right = (b.y - a.y) * (p.x - a.x);
    const double area = left - right;
    if (std::abs(area) > 4e-16 * (std::abs(left) + std::abs(right)))
        return signOf(area);
    return int(CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y),
                                 Kernel::Point_2(p.x, p.y)));
}

/// A direction (first, second·epsilon): bits 0 and 1 are the signs, bit 2 says which axis leads.
glm::dvec2 lead(int k) {
    const double sign = (k & 1) != 0 ? -1.0 : 1.0;
    return (k & 4) != 0 ? glm::dvec2(0.0, sign) : glm::dvec2(sign, 0.0);
}
glm::dvec2 follow(int k) {
    const double sign = (k & 2) != 0 ? -1.0 : 1.0;
    return (k & 4) != 0 ? glm::dvec2(sign, 0.0) : glm::dvec2(0.0, sign);
}

/// On which side of an edge lies the point beside one of its own points, in direction k.
int sideBeside(const glm::dvec2& edge, int k) {
    const auto cross = [&](const glm::dvec2& d) { return edge.x * d.y - edge.y * d.x; };
    const int first = signOf(cross(lead(k)));
    return first != 0 ? first : signOf(cross(follow(k)));
}

/// As raiseCenters computes it, so that both have the same heights.
double heightAt(const TriangleCorners& t, double x, double y) {
    const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
    const double wa = side(t[1], t[2], x, y);
    const double wb = side(t[2], t[0], x, y);
    const double wc = side(t[0], t[1], x, y);
    const double z = (wa * t[0].z + wb * t[1].z + wc * t[2].z) / (wa + wb + wc);
    return std::isfinite(z) ? std::clamp(z, low, high) : low;
}

}  // namespace

std::optional<CenterCrossing> crossingAt(const TriangleCorners& triangle, double x, double y) {
    const std::array<glm::dvec2, 3> corner{glm::dvec2(triangle[0]), glm::dvec2(triangle[1]),
                                           glm::dvec2(triangle[2])};
    const int facing = orientation(corner[0], corner[1], corner[2]);
    if (facing == 0)
        return std::nullopt;
    std::uint8_t beside = kAllBeside;
    for (std::size_t n = 0; n < 3; ++n) {
        const glm::dvec2& a = corner[n];
        const glm::dvec2& b = corner[(n + 1) % 3];
        const int at = orientation(a, b, {x, y});
        if (at == -facing)
            return std::nullopt;
        for (int k = 0; k < 8 && at == 0; ++k) {
            if (sideBeside(b - a, k) != facing)
                beside &= std::uint8_t(~(1U << unsigned(k)));
        }
    }
    return CenterCrossing{heightAt(triangle, x, y), beside, std::int8_t(facing)};
}

}  // namespace reflet
