// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/math/Geometry.h"

#include <string>

namespace reflet {

/// How a projected grid lies on the ground around one place.
struct LocalNorth {
    glm::dvec2 grid{0.0};      ///< the place, east and north in the grid
    double convergence = 0.0;  ///< radians clockwise from true north to grid north
    double scale = 1.0;        ///< metres of the grid per metre on the ellipsoid
};

/// Of a projected CRS in metres at a longitude and latitude (WGS 84, degrees): a cross of 100 m
/// east and north in the plane that touches the ellipsoid there (GeographicLib), seen in the grid
/// (PROJ). On conformal grids the error is below 1e-7 in both. Usage for degrees out of range,
/// Refused for other CRSs and where the grid ends.
[[nodiscard]] Result<LocalNorth> localNorth(const std::string& crs, double longitude,
                                            double latitude);

/// "EPSG:n" of the UTM zone on WGS 84 that a place (degrees) lies in, the exceptions around Norway
/// and Svalbard included. Usage beyond 84 degrees north and 80 south.
[[nodiscard]] Result<std::string> utmZone(double longitude, double latitude);

}  // namespace reflet
