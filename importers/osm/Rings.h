// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/io/PlanPolygon.h"
#include "importers/osm/OsmData.h"

#include <string>
#include <vector>

namespace reflet::osm {

/// The area of a way or of a multipolygon, in degrees: longitude, latitude.
struct OsmArea {
    std::vector<PlanPolygon> polygons;  ///< sound
    bool repaired = false;
    std::string problem;  ///< what was mended, or why there are no polygons
};

/// A closed way. Nodes that the file has not are left out, as a repair.
[[nodiscard]] OsmArea areaOf(const OsmData& data, const Way& way);

/// The rings of a multipolygon, put together from its members: inner ones become holes of the outer
/// one that they lie in, whatever their order and direction. Rings that cannot be closed are left
/// out, as a repair.
[[nodiscard]] OsmArea areaOf(const OsmData& data, const Relation& relation);

}  // namespace reflet::osm
