// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/LoadedCity.h"
#include "app/pipeline/Place.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// How its files are read holds for all city models.
struct ImportRequest : ReadingOptions {
    /// City models; rasters among them count by their content as terrain or orthophoto.
    std::vector<std::filesystem::path> files;
    std::vector<std::filesystem::path> terrain;  ///< rasters of heights, folders or lists of them
    std::vector<std::filesystem::path> orthophotos;
    /// The project file to write; empty = none, and models are named by absolute paths.
    std::filesystem::path output;
    std::string projectCrs;            ///< target; "" = that of the first file
    std::string vertical;              ///< EPSG code of the vertical datum; "" = that of the file
    std::vector<PlaceRequest> places;  ///< of models in local coordinates
    std::optional<std::filesystem::path> routes;
    std::string vehicle;  ///< put on each route: built-in or a glTF file; "" = tram
    std::string date;     ///< ISO 8601; "" = 15 May 10:00 local time
    std::optional<std::filesystem::path>
        projectTemplate;  ///< tuning, light and bake settings come from it
    bool strict = false;
};

struct ImportReport {
    Project project;
    /// The city as loadCity() would read it for the project: it need not be read again.
    std::shared_ptr<const LoadedCity> city;
    std::vector<Diagnostic> remarks;
};

/// Reads the files, makes a project of them and writes it. Nothing is written unless all of it went
/// well. With `strict`, what would be guessed or repaired is Refused.
[[nodiscard]] Result<ImportReport> importProject(const ImportRequest& request,
                                                 const JobContext& job);

/// Adds city files to a project, in its frame, without writing anything: the project with their
/// references. `folder` is where the project's file lies; empty = paths stay absolute. Refused for
/// a file without surfaces.
[[nodiscard]] Result<Project> addModels(Project project, const std::filesystem::path& folder,
                                        const std::vector<std::filesystem::path>& files,
                                        const JobContext& job);

}  // namespace reflet
