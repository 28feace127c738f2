// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/cli/ReadingArguments.h"
#include "app/cli/Reports.h"
#include "app/cli/VehicleReport.h"
#include "importers/CityFiles.h"
#include "importers/terrain/TerrainImporter.h"

#include <algorithm>
#include <system_error>

namespace reflet::cli {

namespace {

/// The files that are meant; a folder of rasters is told file by file.
Result<std::vector<std::filesystem::path>> filesOf(const InfoArguments& arguments,
                                                   const Console& console) {
    const auto named = cityFilesOf({arguments.files.begin(), arguments.files.end()}, console.job());
    if (!named)
        return tl::unexpected(named.error());
    for (const auto& remark : named->remarks)
        console.note(remark);
    std::vector<std::filesystem::path> files;
    for (const auto& file : named->files) {
        std::error_code ignored;
        const auto rasters = rasterFiles(file);
        if (rasters && std::filesystem::is_directory(file, ignored))
            files.insert(files.end(), rasters->begin(), rasters->end());
        else
            files.push_back(file);
    }
    return files;
}

}  // namespace

int run(const InfoArguments& arguments, const Console& console) {
    ImportOptions options;
    options.lod = "all";
    options.crs = arguments.crs;
    if (auto done = addReading(options, arguments.footprints, arguments.axes); !done)
        return console.failed(done.error());
    options.strict = arguments.strict;
    const bool vehicles = std::all_of(arguments.files.begin(), arguments.files.end(),
                                      [](const auto& file) { return isVehicleFile(file); });
    // With a CRS or axes, a glTF file is meant as a city.
    const bool asCity =
        !arguments.crs.empty() || !arguments.axes.up.empty() || !arguments.axes.unit.empty();
    if (vehicles && !asCity && !arguments.files.empty())
        return reportVehicles(arguments.files, console);
    const auto files = filesOf(arguments, console);
    if (!files)
        return console.failed(files.error());
    std::vector<FileReport> reports;
    for (const auto& file : *files) {
        const ReadingClock clock;
        auto seen = inspectFile(file, options, console.job());
        if (!seen)
            return console.failed(seen.error());
        reports.push_back(FileReport{file.string(), std::move(seen->value), seen->counts,
                                     std::move(seen->diagnostics)});
        clock.note(reports.back());
    }
    if (console.json()) {
        console.data(toJson(reports));
    } else {
        for (const auto& report : reports)
            print(report, console);
    }
    return kDone;
}

}  // namespace reflet::cli
