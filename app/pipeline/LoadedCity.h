// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"
#include "core/project/Project.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// What came of one source file.
struct FileReport {
    std::string file;
    SourceSummary summary;
    ImportCounts counts;
    std::vector<Diagnostic> diagnostics;
};

/// All models of a project as one city in the project's frame.
struct LoadedCity {
    CityModel city;
    std::vector<FileReport> files;
    bool generatedGround = false;  ///< no file had terrain and one was interpolated
    /// ContentHash over everything that the city depends on: bytes of models and textures, options.
    std::string contentHash;
};

/// Reads a file of any format that Reflet knows; the content decides. Unreadable for the rest, with
/// the formats that are known.
[[nodiscard]] Result<Imported<CityImport>> importFile(const std::filesystem::path& path,
                                                      const ImportOptions& options,
                                                      const JobContext& job);
/// What is in the file, in its own CRS, all levels of detail counted together.
[[nodiscard]] Result<Imported<SourceSummary>> inspectFile(const std::filesystem::path& path,
                                                          const ImportOptions& options,
                                                          const JobContext& job);

/// Reads the models of a project whose file lies in `folder`. A missing model is Unreadable, with
/// the path that was looked for.
[[nodiscard]] Result<LoadedCity> loadCity(const Project& project,
                                          const std::filesystem::path& folder,
                                          const JobContext& job);

/// Hex ContentHash of a file's bytes.
[[nodiscard]] Result<std::string> fileHash(const std::filesystem::path& path);

/// The path of a model of the project, made absolute.
[[nodiscard]] std::filesystem::path modelPath(const ModelReference& model,
                                              const std::filesystem::path& folder);

}  // namespace reflet
