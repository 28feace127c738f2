// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/ProjectFrame.h"

#include "core/geo/Crs.h"

#include <cmath>
#include <geodesic.h>

namespace reflet {

glm::dvec3 frameOrigin(const glm::dvec3& center) {
    constexpr double kStep = 1000.0;
    return {std::round(center.x / kStep) * kStep, std::round(center.y / kStep) * kStep, 0.0};
}

Result<GeoPosition> geoPosition(const ProjectFrame& frame, const glm::dvec3& point) {
    if (!frame.crs)
        return fail(ErrorCode::Refused, "local coordinates have no place on the Earth", {},
                    "Give the city a coordinate reference system.");
    const auto crs = Crs::parse(*frame.crs);
    if (!crs)
        return tl::unexpected(crs.error());
    if (!crs->isProjected())
        return fail(ErrorCode::Refused, "the project's system is not a projected one", *frame.crs,
                    "Choose a projected system in metres.");
    const auto wgs84 = Crs::parse("EPSG:4326");
    if (!wgs84)
        return tl::unexpected(wgs84.error());
    const auto transform = CrsTransform::create(*crs, *wgs84);
    if (!transform)
        return tl::unexpected(transform.error());

    // Grid north is where the grid's y leads: the bearing of the geodesic between two points of
    // one grid line, half of kReach on either side. Its turn over that way is far below 1e-6 rad.
    constexpr double kReach = 100.0;
    const glm::dvec3 absolute = frame.origin + point;
    const glm::dvec3 half(0.0, 0.5 * kReach / crs->metresPerUnit(), 0.0);
    std::vector<glm::dvec3> points{absolute, absolute - half, absolute + half};
    if (auto done = transform->apply(points); !done)
        return tl::unexpected(done.error());

    geod_geodesic ellipsoid{};
    geod_init(&ellipsoid, 6378137.0, 1.0 / 298.257223563);  // WGS 84
    double bearingSouth = 0.0;
    double bearingNorth = 0.0;
    geod_inverse(&ellipsoid, points[1].y, points[1].x, points[2].y, points[2].x, nullptr,
                 &bearingSouth, &bearingNorth);
    constexpr double kDegree = kPi / 180.0;
    const double bearing = bearingSouth + 0.5 * std::remainder(bearingNorth - bearingSouth, 360.0);
    return GeoPosition{points[0].x * kDegree, points[0].y * kDegree,
                       std::remainder(bearing, 360.0) * kDegree};
}

}  // namespace reflet
