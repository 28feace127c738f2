// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/math/Geometry.h"

#include <optional>
#include <string>

namespace reflet {

/// The frame that everything inside Reflet lives in: a projected CRS in metres (or local metres
/// when `crs` is empty) minus a double-precision origin; x grid east, y grid north, z up in the
/// vertical datum `vertical` (a label; empty = unknown).
struct ProjectFrame {
    std::optional<std::string> crs;       ///< "EPSG:n" or WKT, horizontal; nullopt = local metres
    std::optional<std::string> vertical;  ///< "EPSG:n"
    glm::dvec3 origin{0.0};               ///< in the CRS; whole kilometres, z = 0

    friend bool operator==(const ProjectFrame&, const ProjectFrame&) = default;
};

/// The frame's origin for data around `center`: rounded to 1000 m horizontally, 0 vertically.
[[nodiscard]] glm::dvec3 frameOrigin(const glm::dvec3& center);

/// Where a point of the frame lies on the Earth (WGS 84), and how the grid is turned there.
struct GeoPosition {
    double longitude = 0.0;    ///< radians, east positive
    double latitude = 0.0;     ///< radians, north positive
    double convergence = 0.0;  ///< radians clockwise from true north to grid north
};

/// Refused for a local frame, or when PROJ has no way to WGS 84.
[[nodiscard]] Result<GeoPosition> geoPosition(const ProjectFrame& frame, const glm::dvec3& point);

}  // namespace reflet
