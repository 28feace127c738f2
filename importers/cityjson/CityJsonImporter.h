// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <string_view>

namespace reflet {

/// Reads a CityJSON 1.0, 1.1 or 2.0 file (simdjson). The frame's origin is subtracted in double
/// while parsing. Each city object is accounted for as loaded, repaired or skipped; one bad object
/// never costs the file. Geometry templates are placed as triangles.
[[nodiscard]] Result<Imported<CityImport>> importCityJson(const std::filesystem::path& path,
                                                          const ImportOptions& options,
                                                          const JobContext& job);

/// The same from bytes; textures are looked for beside `path`, which need not exist.
[[nodiscard]] Result<Imported<CityImport>> importCityJsonText(std::string_view text,
                                                              const std::filesystem::path& path,
                                                              const ImportOptions& options,
                                                              const JobContext& job);

/// What is in the file, all levels of detail counted together, in the file's own CRS.
[[nodiscard]] Result<Imported<SourceSummary>> inspectCityJson(const std::filesystem::path& path,
                                                              const ImportOptions& options,
                                                              const JobContext& job);

/// Reads the file's JSON from end to end and keeps nothing of it: what an import is measured
/// against. Errors as importCityJson() of a text that is no JSON.
[[nodiscard]] Result<void> parseCityJson(const std::filesystem::path& path, const JobContext& job);

}  // namespace reflet
