// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/extrusion/Building.h"
#include "importers/osm/OsmData.h"

#include <cstddef>
#include <vector>

namespace reflet::osm {

/// What is told once about the buildings of a file.
struct OsmTally {
    std::size_t buildings = 0;   ///< that are shown
    std::size_t assumed = 0;     ///< of them: nothing told the height
    std::size_t unreadable = 0;  ///< heights or levels that mean nothing
    std::size_t unknownRoofs = 0;
};

/// All buildings and building parts of the data, ways before relations, each part right behind its
/// building. A building whose parts cover half of it or more is shown by them alone, as Simple 3D
/// Buildings has it. Ids are "way/123" and "relation/45".
struct OsmBuildings {
    std::vector<extrusion::Building> buildings;
    OsmTally tally;
};
[[nodiscard]] OsmBuildings buildingsOf(const OsmData& data, double defaultHeight,
                                       const JobContext& job);

}  // namespace reflet::osm
