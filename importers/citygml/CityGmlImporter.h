// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <string_view>

namespace reflet {

/// Reads CityGML 1.0, 2.0 and 3.0 (pugixml), one member of the city at a time, so that only the
/// model and the appearances beside the members grow with the file. Boundary surfaces, windows and
/// doors are objects with the city object that they bound as parent. References within the file are
/// followed, forward too; what lies in other files is not. Axes are read in the order of the CRS's
/// authority, unless the coordinates fit the other order only. Else as importCityJson().
[[nodiscard]] Result<Imported<CityImport>> importCityGml(const std::filesystem::path& path,
                                                         const ImportOptions& options,
                                                         const JobContext& job);

/// The same from bytes; textures are looked for beside `path`, which need not exist.
[[nodiscard]] Result<Imported<CityImport>> importCityGmlText(std::string_view text,
                                                             const std::filesystem::path& path,
                                                             const ImportOptions& options,
                                                             const JobContext& job);

/// What is in the file, all levels of detail counted together, in the file's own CRS; polygons are
/// counted once, where they are defined.
[[nodiscard]] Result<Imported<SourceSummary>> inspectCityGml(const std::filesystem::path& path,
                                                             const ImportOptions& options,
                                                             const JobContext& job);

}  // namespace reflet
