// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/osm/OsmData.h"
#include "importers/trees/TreeShape.h"

#include <cstddef>
#include <vector>

namespace reflet::osm {

/// natural=tree
[[nodiscard]] bool isTree(const Tags& tags);

struct OsmTrees {
    std::vector<trees::Tree> trees;  ///< in the file's order; ids are "node/123"
    std::size_t heightAssumed = 0;   ///< trees without a height that means something
    std::size_t crownAssumed = 0;
};
/// By height, diameter_crown, circumference (all in metres), leaf_type and the names of the
/// species.
[[nodiscard]] OsmTrees treesOf(const OsmData& data);

}  // namespace reflet::osm
