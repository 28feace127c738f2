// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <string_view>

namespace reflet {

/// Reads a CityJSON text sequence (CityJSONSeq 1.1 or 2.0): a first line with version, transform,
/// CRS and geometry templates, then one feature on each line. Some megabytes of lines are in memory
/// at a time, so that only the model grows with the file. A line that cannot be read is reported
/// with its number and skipped; only a first line without which nothing can be placed ends the
/// import. Else as importCityJson().
[[nodiscard]] Result<Imported<CityImport>> importCityJsonSeq(const std::filesystem::path& path,
                                                             const ImportOptions& options,
                                                             const JobContext& job);

/// The same from bytes; textures are looked for beside `path`, which need not exist.
[[nodiscard]] Result<Imported<CityImport>> importCityJsonSeqText(std::string_view text,
                                                                 const std::filesystem::path& path,
                                                                 const ImportOptions& options,
                                                                 const JobContext& job);

/// What is in the file, all levels of detail counted together, in the file's own CRS.
[[nodiscard]] Result<Imported<SourceSummary>> inspectCityJsonSeq(const std::filesystem::path& path,
                                                                 const ImportOptions& options,
                                                                 const JobContext& job);

}  // namespace reflet
