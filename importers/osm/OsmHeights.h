// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/extrusion/Solid.h"
#include "importers/osm/OsmData.h"

namespace reflet::osm {

/// building=* or building:part=*, as an area that stands there.
[[nodiscard]] bool isBuilding(const Tags& tags);
[[nodiscard]] bool isBuildingPart(const Tags& tags);
/// Below the ground, by its tags.
[[nodiscard]] bool isUnderground(const Tags& tags);

/// What the tags of Simple 3D Buildings say of a building on a footprint.
struct OsmShape {
    extrusion::Levels levels;
    extrusion::Roof roof;
    bool assumed = false;      ///< nothing tells the height
    bool unreadable = false;   ///< a height or a number of levels means nothing
    bool unknownRoof = false;  ///< a shape that is drawn flat
};

/// height, else building:levels times 3.1 m and the roof on top of that, else `defaultHeight` (a
/// storey for garages and the like); min_height, else building:min_level. Roofs rise by
/// roof:height, roof:levels or roof:angle, else by 30 degrees and no more than half the building. A
/// building=roof is a slab of 0.3 m under its roof. `metres`: the footprint.
[[nodiscard]] OsmShape shapeOf(const Tags& tags, const PlanPolygon& metres, double defaultHeight);

}  // namespace reflet::osm
