// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/Crs.h"

#include <optional>
#include <string>

namespace reflet {

/// Texts and numbers only: a PROJ object belongs to one thread's context, so each user makes its
/// own from `definition`.
struct Crs::Impl {
    enum class Kind { Geographic, Geocentric, Projected };

    std::string definition;  ///< of the horizontal part, for proj_create: "EPSG:n" or WKT
    std::optional<std::string> vertical;
    std::string name;
    std::string wkt;
    Kind kind = Kind::Projected;
    double metresPerUnit = 1.0;
    /// Area of use in the CRS's own axes, (east, north).
    struct Area {
        glm::dvec2 min;
        glm::dvec2 max;
    };
    std::optional<Area> area;
};

}  // namespace reflet
