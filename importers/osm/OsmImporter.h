// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/io/GeoFile.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace reflet {

/// Reads the buildings and building parts of OpenStreetMap data, XML or PBF (libosmium), after
/// Simple 3D Buildings (importers/osm/OsmHeights.h): closed solids with ground, walls and roof,
/// heights above the ground (CityImport::aboveGround). Degrees are brought into the frame's CRS,
/// else into the UTM zone. Each building is accounted for as loaded, repaired or skipped.
[[nodiscard]] Result<Imported<CityImport>> importOsm(const std::filesystem::path& path,
                                                     const ImportOptions& options,
                                                     const JobContext& job);

/// The same from bytes.
[[nodiscard]] Result<Imported<CityImport>> importOsmBytes(std::string_view bytes,
                                                          const std::filesystem::path& name,
                                                          const ImportOptions& options,
                                                          const JobContext& job);

/// What is in the file, in degrees; heights above the ground.
[[nodiscard]] Result<Imported<SourceSummary>> inspectOsm(const std::filesystem::path& path,
                                                         const ImportOptions& options,
                                                         const JobContext& job);

/// Whether a file is OpenStreetMap data, by its beginning.
[[nodiscard]] bool isOsmFile(const std::filesystem::path& path);

/// Lines that vehicles can drive, in the frame's CRS (z = NaN): tram lines, and streets that are
/// open to cars or buses. Ways of one name that follow each other are one line; those shorter than
/// 50 m are left out. Tram lines come first, then streets, the longest first.
struct OsmRoutes {
    std::vector<GeoLine> lines;
    std::size_t trams = 0;  ///< the first so many of them
};
/// Refused when the frame is in local metres.
[[nodiscard]] Result<OsmRoutes> readOsmRoutes(const std::filesystem::path& path,
                                              const ProjectFrame& frame, const JobContext& job);

}  // namespace reflet
