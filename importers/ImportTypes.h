// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Diagnostic.h"
#include "core/city/CityModel.h"

namespace reflet {

/// What is asked of an importer.
struct ImportOptions {
    std::string lod = "highest";     ///< "highest" per object, "all" (inspection only), or a value such as "2.2"
    std::string crs;                 ///< CRS of a file that declares none; "" = unknown, "local" = local metres
    std::optional<ProjectFrame> frame;  ///< the frame to import into; nullopt = made from the file
    std::vector<std::string> types;  ///< CityJSON type names to load; empty = all
    std::optional<std::array<double, 4>> bbox;  ///< E0, N0, E1, N1 in the target CRS; objects that touch it are kept
    bool strict = false;             ///< refuse what would otherwise be repaired or guessed
    std::size_t maxFileBytes = std::size_t(4) << 30;
};

/// What `info` and `import` tell about a file; keys of the JSON reports in DESIGN section 7.
struct SourceSummary {
    std::string format;              ///< "CityJSON"
    std::string version;
    std::optional<std::string> crsHorizontal;  ///< "EPSG:n"
    std::optional<std::string> crsVertical;
    std::size_t objects = 0;
    std::map<std::string, std::size_t> byType;
    std::vector<std::string> lods;   ///< ascending
    std::size_t surfaces = 0;
    std::size_t triangles = 0;       ///< without template instances
    std::size_t instanceTriangles = 0;
    std::size_t instances = 0;
    std::size_t vertices = 0;
    Box bounds;                      ///< source CRS: east, north, up
    std::size_t texturesReferenced = 0;
    std::size_t texturesResolved = 0;
};

struct CityImport {
    CityModel city;
    SourceSummary summary;  ///< of what was loaded
};

}  // namespace reflet
