// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"

#include <filesystem>

namespace reflet {

/// Reads all city models and terrains of a .zip file as one, in the frame of the first: those that
/// cityFilesIn() finds in it once it is unpacked (see unpackArchive). Archives in the archive are
/// left out. A model that cannot be read costs that model alone, unless it is the only one or
/// `strict` is asked for. Errors and remarks name the file in the archive.
[[nodiscard]] Result<Imported<CityImport>> importArchive(const std::filesystem::path& path,
                                                         const ImportOptions& options,
                                                         const JobContext& job);
/// What is in it, all files together.
[[nodiscard]] Result<Imported<SourceSummary>> inspectArchive(const std::filesystem::path& path,
                                                             const ImportOptions& options,
                                                             const JobContext& job);

}  // namespace reflet
