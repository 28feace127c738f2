// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/cli/ReadingArguments.h"
#include "app/cli/Reports.h"
#include "app/pipeline/Import.h"
#include "app/pipeline/ImportReportJson.h"
#include "core/base/Files.h"
#include "importers/CityFiles.h"

#include <fmt/format.h>

namespace reflet::cli {

namespace {

/// A list is named with an @ before it.
std::vector<std::filesystem::path> rasterPaths(const std::vector<std::string>& texts) {
    std::vector<std::filesystem::path> paths;
    for (const std::string& text : texts)
        paths.emplace_back(text.starts_with('@') ? text.substr(1) : text);
    return paths;
}

Result<ImportRequest> requestOf(const ImportArguments& arguments) {
    ImportRequest request;
    request.terrain = rasterPaths(arguments.terrain);
    request.orthophotos = rasterPaths(arguments.orthophotos);
    request.output = arguments.output;
    request.crs = arguments.crs;
    request.projectCrs = arguments.projectCrs;
    request.vertical = arguments.vertical;
    for (const auto& text : arguments.places) {
        auto place = parsePlace(text);
        if (!place)
            return tl::unexpected(place.error());
        place->crs = arguments.projectCrs;
        request.places.push_back(std::move(*place));
    }
    request.lod = arguments.lod;
    request.types = splitList(arguments.types);
    if (auto done = addReading(request, arguments.footprints, arguments.axes); !done)
        return tl::unexpected(done.error());
    request.vehicle = arguments.vehicle;
    request.date = arguments.date;
    request.strict = arguments.strict;
    if (!arguments.routes.empty())
        request.routes = arguments.routes;
    if (!arguments.projectTemplate.empty())
        request.projectTemplate = arguments.projectTemplate;
    if (!arguments.bbox.empty()) {
        const auto box = parseNumbers(arguments.bbox, 4, 4, "--bbox");
        if (!box)
            return tl::unexpected(box.error());
        request.bbox = {(*box)[0], (*box)[1], (*box)[2], (*box)[3]};
    }
    return request;
}

Result<void> writeReport(const std::string& path, const std::string& project,
                         const ImportReport& report) {
    if (path.empty())
        return {};
    const LoadedCity& city = *report.city;
    return writeFileAtomically(
        path, importReportText({project, report.project.frame, city.generatedGround, city.groundFit,
                                report.remarks, city.files, city.city.objects}));
}

}  // namespace

int run(const ImportArguments& arguments, const Console& console) {
    auto request = requestOf(arguments);
    if (!request)
        return console.failed(request.error());
    auto files = cityFilesOf({arguments.files.begin(), arguments.files.end()}, console.job());
    if (!files)
        return console.failed(files.error());
    for (const auto& remark : files->remarks)
        console.note(remark);
    request->files = std::move(files->files);
    const auto report = importProject(*request, console.job());
    if (!report)
        return console.failed(report.error());
    if (const auto written = writeReport(arguments.report, arguments.output, *report); !written)
        return console.failed(written.error());
    const Project& project = report->project;
    for (const auto& remark : report->remarks)
        console.note(remark);
    if (console.json()) {
        nlohmann::json out = toJson(report->city->files);
        out["project"] = arguments.output;
        out["origin"] = {project.frame.origin.x, project.frame.origin.y, project.frame.origin.z};
        out["generatedGround"] = report->city->generatedGround;
        out["groundFit"] = groundFitJson(report->city->groundFit);
        out["remarks"] = toJson(report->remarks);
        out["routes"] = project.routes.size();
        console.data(out);
        return kDone;
    }
    for (const auto& file : report->city->files)
        print(file, console);
    console.text(fmt::format("{}: {}, origin {:.0f} {:.0f} subtracted", arguments.output,
                             project.frame.crs.value_or("local coordinates"),
                             project.frame.origin.x, project.frame.origin.y));
    if (report->city->generatedGround)
        console.note(
            "The files hold no terrain: a ground is generated from the bases of the buildings.");
    if (project.routes.empty()) {
        console.note(
            fmt::format("Next: reflet-cli edit {} --route LINE.geojson --vehicle tram1=tram,ROUTE "
                        "--probes-every 15",
                        arguments.output));
    } else {
        console.note(fmt::format("Next: reflet-cli edit {} --probes-every 15", arguments.output));
    }
    return kDone;
}

}  // namespace reflet::cli
