// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/LocalNorth.h"

#include "core/geo/Crs.h"

#include <fmt/format.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <exception>
#include <vector>

namespace reflet {

namespace {

Result<void> checkDegrees(double longitude, double latitude) {
    if (std::abs(longitude) <= 180.0 && std::abs(latitude) < 90.0)
        return {};
    return fail(ErrorCode::Usage, "this is no place on the Earth",
                fmt::format("{}, {}", longitude, latitude),
                "Give the longitude first, east positive, then the latitude, in degrees.");
}

}  // namespace

Result<LocalNorth> localNorth(const std::string& crs, double longitude, double latitude) {
    if (auto sound = checkDegrees(longitude, latitude); !sound)
        return tl::unexpected(sound.error());
    const auto grid = Crs::parse(crs);
    if (!grid)
        return tl::unexpected(grid.error());
    if (!grid->isProjected() || grid->metresPerUnit() != 1.0)
        return fail(ErrorCode::Refused, "is not a projected system in metres", crs,
                    "Choose one, for example the UTM zone.");
    const auto wgs84 = Crs::parse("EPSG:4326");
    if (!wgs84)
        return tl::unexpected(wgs84.error());
    const auto transform = CrsTransform::create(*wgs84, *grid);
    if (!transform)
        return tl::unexpected(transform.error());

    constexpr double kReach = 50.0;
    const GeographicLib::LocalCartesian plane(latitude, longitude, 0.0);
    std::vector<glm::dvec3> points{{longitude, latitude, 0.0}};
    for (const glm::dvec2 step : {glm::dvec2(-kReach, 0), {kReach, 0}, {0, -kReach}, {0, kReach}}) {
        glm::dvec3 point(0.0);
        plane.Reverse(step.x, step.y, 0.0, point.y, point.x, point.z);
        points.push_back(point);
    }
    if (auto done = transform->apply(points); !done)
        return tl::unexpected(done.error());
    const glm::dvec2 east(points[2] - points[1]);
    const glm::dvec2 north(points[4] - points[3]);
    LocalNorth out;
    out.grid = glm::dvec2(points[0]);
    // The bearing of true north in the grid, the other way round.
    out.convergence = -std::atan2(north.x, north.y);
    out.scale = std::sqrt(std::abs(east.x * north.y - east.y * north.x)) / (2.0 * kReach);
    return out;
}

Result<std::string> utmZone(double longitude, double latitude) {
    if (auto sound = checkDegrees(longitude, latitude); !sound)
        return tl::unexpected(sound.error());
    try {
        const int zone = GeographicLib::UTMUPS::StandardZone(latitude, longitude);
        if (zone >= GeographicLib::UTMUPS::MINUTMZONE)
            return fmt::format("EPSG:{}", (latitude >= 0.0 ? 32600 : 32700) + zone);
    } catch (const std::exception&) {
        // falls through to the refusal
    }
    return fail(ErrorCode::Usage, "there is no UTM zone so near to a pole",
                fmt::format("{}, {}", longitude, latitude), "Name a system with --project-crs.");
}

}  // namespace reflet
