// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace reflet {

/// A polygon in the plan, in the units of whatever CRS it comes from: east, north. The first ring
/// is the outer one, the others are holes; rings are not closed by a repeated point.
struct PlanPolygon {
    std::vector<std::vector<glm::dvec2>> rings;
};

/// Sound polygons: outer rings counter-clockwise, holes clockwise, no point twice in a row, no
/// crossing edges, at least three corners.
struct MendedPolygons {
    std::vector<PlanPolygon> polygons;
    bool repaired = false;  ///< something had to be mended: more than the direction of a ring
    std::string problem;    ///< what was wrong with it, or why nothing is left
};

/// Twice the signed area, counter-clockwise positive; summed from the first point, so that far from
/// the origin nothing is lost.
[[nodiscard]] double doubleArea(const std::vector<glm::dvec2>& ring);

/// Makes a polygon sound. What is inside stays inside by even-odd parity (GEOS's MakeValid, through
/// GDAL); a closing point and points repeated in a row are dropped, the former without counting as
/// a repair. Without polygons, and with a problem, when nothing with an area is left or a
/// coordinate is not finite.
[[nodiscard]] MendedPolygons mendPolygon(PlanPolygon polygon);

}  // namespace reflet
