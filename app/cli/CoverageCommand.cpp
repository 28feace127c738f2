// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/cli/DemandOptions.h"
#include "app/pipeline/coverage/CoverageFiles.h"
#include "app/pipeline/coverage/CoverageJson.h"
#include "app/pipeline/coverage/CoverageThumbnails.h"
#include "core/base/Files.h"
#include "core/io/ImageFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace reflet::cli {

namespace {

namespace fs = std::filesystem;

void tellRoutes(const CoverageReport& report, const Console& console) {
    if (report.routes.empty())
        return;
    console.text(fmt::format("{:<24} {:>9} {:>9} {:>8} {:>8} {:>8} {:>9}", "route", "metres",
                             "coverage", "seen", "worst", "5 %", "gap"));
    for (const RouteCoverage& route : report.routes) {
        const LineFigures& f = route.figures;
        console.text(
            fmt::format("{:<24} {:>9.0f} {:>7.1f} % {:>6.1f} % {:>6.1f} % {:>6.1f} % "
                        "{:>7.0f} m",
                        route.name, f.length, 100.0 * f.coverage, 100.0 * f.seen, 100.0 * f.worst,
                        100.0 * f.p05, f.largestGap));
    }
}

void tellWorst(const CoverageReport& report, const Console& console) {
    for (std::size_t k = 0; k < report.worst.size(); ++k) {
        const WorstPlace& place = report.worst[k];
        console.text(
            fmt::format("worst {}: {:.1f} % on {} from {:.0f} to {:.0f} m, at {:.1f}, "
                        "{:.1f}",
                        k + 1, 100.0 * place.coverage, place.name, place.from, place.to,
                        place.position.x, place.position.y));
    }
}

void tellFacades(const CoverageReport& report, const Console& console) {
    constexpr std::size_t kMost = 5;
    if (report.reflectedWalls > 0.0)
        console.text(
            fmt::format("façades: {:.0f} of {:.0f} m² that vehicles reflect are shown by "
                        "no probe",
                        report.uncoveredWalls, report.reflectedWalls));
    for (std::size_t k = 0; k < std::min(kMost, report.objects.size()); ++k) {
        const ObjectCoverage& object = report.objects[k];
        console.text(fmt::format("  {:.0f} of {:.0f} m² of {} {}", object.uncovered,
                                 object.reflected, object.type, object.object));
    }
    if (report.objects.size() > kMost)
        console.text(fmt::format("  and {} further objects", report.objects.size() - kMost));
}

/// Those that could go, or stand for nothing.
void tellWaste(const CoverageReport& report, const Console& console) {
    constexpr double kLittle = 0.0005;
    std::string names;
    for (const ProbeCoverage& probe : report.probes)
        if (probe.loss < kLittle)
            names += (names.empty() ? "" : ", ") + probe.id;
    if (!names.empty())
        console.text("little would be lost without any one of: " + names);
}

void tell(const CoverageReport& report, const Console& console) {
    console.text(fmt::format(
        "coverage {:.1f} % ± {:.1f} %; seen by one probe {:.1f} %, by two "
        "{:.1f} %; shown {:.1f} %",
        100.0 * report.coverage.mean, 100.0 * report.coverage.error, 100.0 * report.seen.mean,
        100.0 * report.seenTwice.mean, 100.0 * report.shown.mean));
    tellRoutes(report, console);
    tellWorst(report, console);
    tellFacades(report, console);
    tellWaste(report, console);
}

Result<void> writeThumbnails(const CoverageReport& report, const PreparedCity& city,
                             const CoverageArguments& arguments, const fs::path& path,
                             const Console& console) {
    const auto sheet =
        worstPlaces(report, city, {arguments.demand.vehicle, 480, 270, 2}, console.job());
    return sheet ? writePng(*sheet, path) : tl::unexpected(sheet.error());
}

/// All files that there are, into one folder.
Result<void> writeFolder(const CoverageReport& report, const PreparedCity& city,
                         const CoverageArguments& arguments, const fs::path& folder,
                         const Console& console) {
    if (auto made = makeFolder(folder); !made)
        return made;
    for (const char* name : {"coverage.json", "coverage.csv", "coverage.geojson", "coverage.gpkg",
                             "coverage.tif", "coverage.png"})
        if (auto written = writeCoverage(report, city, folder / name); !written)
            return written;
    if (report.worst.empty())
        return {};
    auto written = writeThumbnails(report, city, arguments, folder / "worst-places.png", console);
    if (!written && written.error().code == ErrorCode::Refused) {
        console.note(Diagnostic{Severity::Warning, "no-thumbnails", "worst-places.png",
                                "It was not written: " + written.error().what + ".",
                                written.error().remedy});
        return {};
    }
    return written;
}

bool isFolder(const std::string& output) {
    std::error_code failed;
    return output.ends_with('/') || fs::is_directory(output, failed);
}

/// So that a name that cannot be written fails before the work.
Result<void> checkOutputs(const std::vector<std::string>& outputs) {
    const auto known = {".json", ".csv", ".geojson", ".gpkg", ".tif", ".tiff", ".png"};
    for (const std::string& output : outputs) {
        const std::string suffix = fs::path(output).extension().string();
        if (!isFolder(output) && std::find(known.begin(), known.end(), suffix) == known.end())
            return fail(ErrorCode::Usage, "is in no form that coverage is written in", output,
                        "End it in .json, .csv, .geojson, .gpkg, .tif or .png, or name a folder "
                        "with / behind.");
    }
    return {};
}

}  // namespace

int run(const CoverageArguments& arguments, const Console& console) {
    if (auto sound = checkOutputs(arguments.outputs); !sound)
        return console.failed(sound.error());
    const auto city = PreparedCity::open(arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    CoverageOptions options;
    take(arguments.demand, options);
    const auto report = reportCoverage(*city, options, console.job());
    if (!report)
        return console.failed(report.error());
    for (const std::string& output : arguments.outputs) {
        const auto written = isFolder(output)
                                 ? writeFolder(*report, *city, arguments, output, console)
                                 : writeCoverage(*report, *city, output);
        if (!written)
            return console.failed(written.error());
    }
    if (!arguments.thumbnails.empty()) {
        const auto written =
            writeThumbnails(*report, *city, arguments, arguments.thumbnails, console);
        if (!written)
            return console.failed(written.error());
    }
    if (console.json())
        console.data(coverageJson(*report, city->project()));
    tell(*report, console);
    return kDone;
}

}  // namespace reflet::cli
