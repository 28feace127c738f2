// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/base/JobContext.h"
#include "importers/osm/OsmData.h"

#include <filesystem>
#include <string_view>

namespace reflet::osm {

/// Where a file's bytes come from.
struct OsmSource {
    std::filesystem::path path;
    std::string_view bytes{};  ///< read in place of the file unless empty
};

/// Whether the beginning of a file is that of OSM XML, or of OSM PBF.
[[nodiscard]] bool looksLikeOsmXml(std::string_view head);
[[nodiscard]] bool looksLikeOsmPbf(std::string_view head);

/// Which ways, relations and nodes to keep.
struct OsmWanted {
    bool (*way)(const Tags& tags);
    bool (*relation)(const Tags& tags);
    bool (*node)(const Tags& tags) = nullptr;  ///< null: none
};

/// Reads OSM XML or PBF (libosmium) in passes over relations, ways and nodes, so that only what is
/// wanted, and the nodes of that, stay in memory. Unreadable with the reader's words when the file
/// is damaged; ResourceLimit when more than 40 million nodes would be kept; Cancelled.
[[nodiscard]] Result<OsmData> readOsm(const OsmSource& source, const OsmWanted& wanted,
                                      const JobContext& job);

}  // namespace reflet::osm
