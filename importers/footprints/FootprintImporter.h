// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <string_view>

namespace reflet {

/// Reads building footprints with heights among their attributes: GeoJSON, GeoPackage, shapefile,
/// FlatGeobuf, CSV (GDAL). Each feature becomes one Building: its polygons, made sound, stand as
/// closed solids with ground, walls and roof. The height is an attribute (importers/footprints/
/// FieldChoice.h), else the number of storeys times 3.1 m, else ImportOptions::defaultHeight, with
/// a warning. Where the ground's elevation is no attribute, heights count from the ground
/// (CityImport::aboveGround). A file that has points and no polygons is a register of trees
/// (importers/trees/TreeImporter.h). Each feature is accounted for as loaded, repaired or skipped.
[[nodiscard]] Result<Imported<CityImport>> importFootprints(const std::filesystem::path& path,
                                                            const ImportOptions& options,
                                                            const JobContext& job);

/// The same from bytes; the name's suffix tells the format where the content does not.
[[nodiscard]] Result<Imported<CityImport>> importFootprintBytes(std::string_view bytes,
                                                                const std::filesystem::path& name,
                                                                const ImportOptions& options,
                                                                const JobContext& job);

/// What is in the file, in its own CRS; heights as above the ground, or in their datum.
[[nodiscard]] Result<Imported<SourceSummary>> inspectFootprints(const std::filesystem::path& path,
                                                                const ImportOptions& options,
                                                                const JobContext& job);

}  // namespace reflet
