// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include <cmath>

namespace reflet::importers {

/// Whether a point is one of the Earth's surface in geocentric coordinates (EPSG:4978): within 60
/// km of the ellipsoid. No city in a projected CRS or in local metres comes near that.
[[nodiscard]] inline bool isGeocentric(const glm::dvec3& p) {
    const double r = glm::length(p);
    return r > 6'297'000.0 && r < 6'438'000.0;
}

/// East, north and up at a geocentric point, as columns: along the WGS 84 ellipsoid through it.
[[nodiscard]] inline glm::dmat3 eastNorthUp(const glm::dvec3& p) {
    constexpr double kMajor = 6378137.0, kMinor = 6356752.314245179;
    const double across = std::hypot(p.x, p.y);
    if (!(across > 1e-6))
        return glm::dmat3(1.0);
    const glm::dvec3 east(-p.y / across, p.x / across, 0.0);
    const glm::dvec3 up = glm::normalize(
        glm::dvec3(p.x / (kMajor * kMajor), p.y / (kMajor * kMajor), p.z / (kMinor * kMinor)));
    return glm::dmat3(east, glm::cross(up, east), up);
}

/// East, north and up at a place on the WGS 84 ellipsoid as columns, and the place itself, all
/// geocentric; longitude and latitude in radians, height above the ellipsoid in metres.
[[nodiscard]] inline glm::dmat4 geocentric_from_local(double longitude, double latitude,
                                                      double height) {
    constexpr double kMajor = 6378137.0, kFlattening = 1.0 / 298.257223563;
    constexpr double kSquare = kFlattening * (2.0 - kFlattening);  // of the eccentricity
    const double sinLat = std::sin(latitude), cosLat = std::cos(latitude);
    const double sinLon = std::sin(longitude), cosLon = std::cos(longitude);
    const double normal = kMajor / std::sqrt(1.0 - kSquare * sinLat * sinLat);
    const glm::dvec3 up(cosLat * cosLon, cosLat * sinLon, sinLat);
    const glm::dvec3 place((normal + height) * up.x, (normal + height) * up.y,
                           (normal * (1.0 - kSquare) + height) * up.z);
    return {glm::dvec4(-sinLon, cosLon, 0.0, 0.0),
            glm::dvec4(-sinLat * cosLon, -sinLat * sinLon, cosLat, 0.0), glm::dvec4(up, 0.0),
            glm::dvec4(place, 1.0)};
}

}  // namespace reflet::importers
