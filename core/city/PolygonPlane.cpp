// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/PolygonPlane.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/linear_least_squares_fitting_3.h>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

std::optional<PolygonPlane> leastSquares(const std::vector<glm::dvec3>& points,
                                         const IndexRings& rings) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_3> cloud;
    for (const auto& ring : rings)
        for (const std::uint32_t i : ring)
            cloud.emplace_back(points[i].x, points[i].y, points[i].z);
    Kernel::Plane_3 fitted;
    Kernel::Point_3 centroid;
    CGAL::linear_least_squares_fitting_3(cloud.begin(), cloud.end(), fitted, centroid,
                                         CGAL::Dimension_tag<0>());
    const Kernel::Vector_3 n = fitted.orthogonal_vector();
    const glm::dvec3 normal(n.x(), n.y(), n.z());
    const double length = glm::length(normal);
    if (!(length > 0.0) || !std::isfinite(length))
        return std::nullopt;
    return PolygonPlane{{centroid.x(), centroid.y(), centroid.z()}, normal / length};
}

}  // namespace

double PolygonPlane::distance(const glm::dvec3& p) const {
    return std::abs(glm::dot(p - point, normal));
}

bool RingNormal::vanishes() const {
    return glm::length(area) <= kVanishingArea * perimeter * perimeter;
}

RingNormal ringNormal(const std::vector<glm::dvec3>& points,
                      const std::vector<std::uint32_t>& ring) {
    RingNormal out;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec3& a = points[ring[i]];
        const glm::dvec3& b = points[ring[(i + 1) % ring.size()]];
        out.area += glm::cross(a, b);
        out.perimeter += glm::distance(a, b);
    }
    return out;
}

double planeDeviation(const PolygonPlane& plane, const std::vector<glm::dvec3>& points,
                      const IndexRings& rings) {
    double greatest = 0.0;
    for (const auto& ring : rings)
        for (const std::uint32_t i : ring)
            greatest = std::max(greatest, plane.distance(points[i]));
    return greatest;
}

std::optional<PolygonPlane> fitPlane(const std::vector<glm::dvec3>& points,
                                     const IndexRings& rings) {
    constexpr double kDoubtful = 1e-3;  // of the perimeter squared
    const auto& outer = rings.front();
    const RingNormal newell = ringNormal(points, outer);
    const double length = glm::length(newell.area);
    std::optional<PolygonPlane> plane;
    if (!newell.vanishes()) {
        glm::dvec3 centroid(0.0);
        for (const std::uint32_t i : outer)
            centroid += points[i];
        plane = PolygonPlane{centroid / double(outer.size()), newell.area / length};
    }
    if (length >= kDoubtful * newell.perimeter * newell.perimeter)
        return plane;

    std::optional<PolygonPlane> fitted = leastSquares(points, rings);
    if (!fitted)
        return plane;
    if (plane && glm::dot(fitted->normal, newell.area) < 0.0)
        fitted->normal = -fitted->normal;
    const bool closer = !plane || planeDeviation(*fitted, points, rings) <
                                      0.5 * planeDeviation(*plane, points, rings);
    return closer ? fitted : plane;
}

glm::dvec3 DominantAxis::lift(double u, double v, const PolygonPlane& plane) const {
    glm::dvec3 p(0.0);
    p[m_u] = u;
    p[m_v] = v;
    const glm::dvec3& n = plane.normal;
    p[m_w] = plane.point[m_w] -
             (n[m_u] * (u - plane.point[m_u]) + n[m_v] * (v - plane.point[m_v])) / n[m_w];
    return p;
}

}  // namespace reflet
