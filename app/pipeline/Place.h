// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"
#include "core/project/Project.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace reflet {

/// By hand: moved by an offset and turned about the model's zero.
struct PlaceByOffset {
    glm::dvec3 offset{0.0};  ///< metres; from the model's own coordinates to the project's
    double heading = 0.0;    ///< radians, clockwise from grid north to the model's +y
};

/// By two points that are known in both: the middle between them is kept, and the direction.
struct PlaceByPoints {
    std::array<glm::dvec2, 2> inModel{};
    std::array<glm::dvec2, 2> onMap{};  ///< in the project's CRS, or that of `crs`
    double up = 0.0;                    ///< metres that it is lifted by
};

/// By the place of the model's zero on the Earth.
struct PlaceByLonLat {
    double longitude = 0.0, latitude = 0.0;  ///< degrees, WGS 84
    double heading = 0.0;                    ///< radians, clockwise from true north to its +y
    double up = 0.0;                         ///< metres that it is lifted by
};

struct PlaceRequest {
    std::string model;  ///< its path in the project, or the end of it; "" = the only one
    std::variant<PlaceByOffset, PlaceByPoints, PlaceByLonLat> how;
    /// The CRS that a project in local metres comes into; "" = for a longitude and latitude the UTM
    /// zone, else none: the project stays local.
    std::string crs;
};

/// What it was read from, e.g. "offset:E,N[,U[,HEADING]]", "points:X1,Y1,E1,N1,X2,Y2,E2,N2[,U]" or
/// "lonlat:LON,LAT[,HEADING[,U]]", headings in degrees, with "MODEL=" before it where there is more
/// than one. Usage.
[[nodiscard]] Result<PlaceRequest> parsePlace(std::string_view text);

/// A model of the project by its path or the end of it; "" = the only one. Usage when none or more
/// than one could be meant, with those that there are.
[[nodiscard]] Result<ModelReference*> findModel(Project& project, const std::string& name);

struct PlacedProject {
    Project project;
    std::vector<Diagnostic> remarks;
};

/// Places a model that is in local coordinates. In a project that has a CRS it alone moves. When a
/// project in local metres gets its CRS by this, everything in it moves along, as one rigid thing:
/// the other local models, probes, routes and views. A model with a CRS of its own can only be
/// moved by an offset, for heights of another datum. Usage for an unknown model and points that lie
/// together, Refused where the CRS does not allow it. `folder` is where the project's file lies.
[[nodiscard]] Result<PlacedProject> placeModel(Project project, const PlaceRequest& request,
                                               const std::filesystem::path& folder,
                                               const JobContext& job);

}  // namespace reflet
