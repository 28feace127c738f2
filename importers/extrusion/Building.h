// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/Crs.h"
#include "importers/common/CityBuilder.h"
#include "importers/extrusion/Solid.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reflet::extrusion {

/// A building as footprints tell of it, before it becomes surfaces.
struct Building {
    importers::ObjectOutline outline;   ///< its geometry is filled in by pieceOf()
    std::vector<PlanPolygon> polygons;  ///< sound, in the source CRS; none: no geometry of its own
    Levels levels;                      ///< metres
    Roof roof;
    bool aboveGround = true;  ///< the levels count from the ground, else in its datum
    std::vector<std::pair<importers::Issue, std::string>> notes;
};

/// Metres east and north that a unit of a source CRS makes, at a place.
class MetricScale {
public:
    /// nullopt: metres.
    explicit MetricScale(const std::optional<Crs>& crs);
    /// `place` in the source CRS.
    [[nodiscard]] glm::dvec2 at(const glm::dvec2& place) const;
    /// Metres of a unit of height.
    [[nodiscard]] double heightUnit() const { return m_degrees ? 1.0 : m_unit; }

private:
    bool m_degrees = false;
    double m_unit = 1.0;
};

/// The polygon in metres around `origin`.
[[nodiscard]] PlanPolygon inMetres(const PlanPolygon& polygon, const glm::dvec2& origin,
                                   const glm::dvec2& metres);

/// Extrudes buildings to a piece of the city: closed solids of LoD 1, and 2 under roofs that are
/// not flat. What the builder does not choose stays without surfaces.
[[nodiscard]] importers::CityPiece pieceOf(importers::CityBuilder& builder,
                                           std::vector<Building> buildings,
                                           const MetricScale& metres);

}  // namespace reflet::extrusion
