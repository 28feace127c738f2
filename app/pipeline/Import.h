// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/LoadedCity.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

struct ImportRequest {
    std::vector<std::filesystem::path> files;
    std::filesystem::path output;  ///< the project file to write
    std::string crs;               ///< of files that declare none; "local"; "" = unknown
    std::string projectCrs;        ///< target; "" = that of the first file
    std::string vertical;          ///< EPSG code of the vertical datum; "" = that of the file
    std::string lod = "highest";
    std::vector<std::string> types;
    std::optional<std::array<double, 4>> bbox;  ///< in the target CRS
    std::optional<std::filesystem::path> routes;
    std::string vehicle;  ///< built-in vehicle put on each route; "" = tram
    std::string date;     ///< ISO 8601; "" = 15 May 10:00 local time
    std::optional<std::filesystem::path>
        projectTemplate;  ///< tuning, light and bake settings come from it
    bool strict = false;
};

struct ImportReport {
    Project project;
    std::vector<FileReport> files;
    bool generatedGround = false;
    std::vector<Diagnostic> remarks;
};

/// Reads the files, makes a project of them and writes it. Nothing is written unless all of it went
/// well. With `strict`, what would be guessed or repaired is Refused.
[[nodiscard]] Result<ImportReport> importProject(const ImportRequest& request,
                                                 const JobContext& job);

}  // namespace reflet
