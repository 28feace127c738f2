// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"
#include "core/io/PlanPolygon.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace reflet::extrusion {

/// A face of a solid: an outer ring and holes, as indices of points, counter-clockwise (holes
/// clockwise) seen from outside.
struct Face {
    SurfaceType type = SurfaceType::Unknown;
    std::vector<std::vector<std::uint32_t>> rings;
};

/// A closed polyhedron in metres, x east, y north: every edge of a face is that of one other face,
/// the other way round.
struct Solid {
    std::vector<glm::dvec3> points;
    std::vector<Face> faces;
};

enum class RoofShape : std::uint8_t { Flat, Gabled, Hipped, Pyramidal, Skillion };

/// The nearest of our shapes to what OpenStreetMap calls `name` ("half-hipped" is hipped); nullopt
/// for a name that means nothing here.
[[nodiscard]] std::optional<RoofShape> roofShape(std::string_view name);

/// What stands on a footprint. bottom < top; bottom <= eaves <= top; metres.
struct Levels {
    double bottom = 0.0;
    double eaves = 0.0;  ///< where a roof that is not flat begins
    double top = 0.0;
};

struct Roof {
    RoofShape shape = RoofShape::Flat;
    bool ridgeAcross = false;          ///< over the shorter side of the building
    std::optional<double> slopesTo{};  ///< radians clockwise from north; where water runs, skillion
};

/// Extrudes a sound polygon (mendPolygon()), in metres, to a solid with ground, walls and roof. A
/// gable's ridge, and the eaves, lie along the longer side of the smallest rectangle around. Hipped
/// roofs are made over four corners, pyramidal ones where all corners are seen from the middle,
/// both without holes; elsewhere `made` says what was taken instead.
struct Extruded {
    Solid solid;
    RoofShape made = RoofShape::Flat;
};
[[nodiscard]] Extruded extruded(const PlanPolygon& polygon, const Levels& levels, const Roof& roof);

/// The half of the width that a roof over the polygon slopes down from its ridge, in metres.
[[nodiscard]] double halfSpan(const PlanPolygon& polygon, bool ridgeAcross);

}  // namespace reflet::extrusion
