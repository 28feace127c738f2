// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/cli/Reports.h"
#include "app/cli/VehicleReport.h"

#include <algorithm>

namespace reflet::cli {

int run(const InfoArguments& arguments, const Console& console) {
    ImportOptions options;
    options.lod = "all";
    options.crs = arguments.crs;
    options.heightField = arguments.footprints.heightField;
    options.baseField = arguments.footprints.baseField;
    options.defaultHeight = arguments.footprints.defaultHeight;
    options.strict = arguments.strict;
    const bool vehicles = std::all_of(arguments.files.begin(), arguments.files.end(),
                                      [](const auto& file) { return isVehicleFile(file); });
    if (vehicles && !arguments.files.empty())
        return reportVehicles(arguments.files, console);
    std::vector<FileReport> reports;
    for (const auto& file : arguments.files) {
        auto seen = inspectFile(file, options, console.job());
        if (!seen)
            return console.failed(seen.error());
        reports.push_back(
            {file, std::move(seen->value), seen->counts, std::move(seen->diagnostics)});
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
