// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Reports.h"

#include "app/pipeline/ImportReportJson.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace reflet::cli {

using nlohmann::json;

json toJson(const FileReport& report) {
    return fileReportJson(report);
}

json toJson(const std::vector<FileReport>& reports) {
    if (reports.size() == 1)
        return toJson(reports.front());
    json out;
    out["files"] = json::array();
    for (const auto& report : reports)
        out["files"].push_back(toJson(report));
    return out;
}

void print(const FileReport& report, const Console& console) {
    const SourceSummary& s = report.summary;
    console.text(report.file);
    console.text(fmt::format("  format     {} {}", s.format, s.version));
    console.text(fmt::format("  CRS        {}, heights {}",
                             s.crsHorizontal.value_or("not declared"),
                             s.crsVertical.value_or("in an unknown datum")));
    if (!s.crsAccount.operation.empty())
        console.text(fmt::format("  operation  {} ({})", s.crsAccount.operation,
                                 s.crsAccount.accuracy
                                     ? fmt::format("accurate to {:g} m", *s.crsAccount.accuracy)
                                     : std::string("accuracy unknown")));
    std::string types;
    for (const auto& [type, count] : s.byType)
        types += fmt::format("{}{} {}", types.empty() ? "" : ", ", count, type);
    console.text(fmt::format("  objects    {} ({})", s.objects, types));
    console.text(fmt::format("  LoDs       {}", fmt::join(s.lods, ", ")));
    console.text(fmt::format("  geometry   {} surfaces, {} triangles, {} vertices", s.surfaces,
                             s.triangles, s.vertices));
    for (const RasterSize& raster : s.raster)
        console.text(fmt::format("  raster     {} x {} pixels, {} bands", raster.columns,
                                 raster.rows, raster.bands));
    if (s.instances > 0)
        console.text(
            fmt::format("  instances  {} with {} triangles", s.instances, s.instanceTriangles));
    if (!s.bounds.empty()) {
        console.text(fmt::format("  bounds     {:.3f} {:.3f} {:.3f} .. {:.3f} {:.3f} {:.3f}",
                                 s.bounds.min.x, s.bounds.min.y, s.bounds.min.z, s.bounds.max.x,
                                 s.bounds.max.y, s.bounds.max.z));
    }
    if (s.texturesReferenced > 0) {
        console.text(
            fmt::format("  textures   {}/{} found", s.texturesResolved, s.texturesReferenced));
    }
    console.text(fmt::format("  result     {} loaded, {} repaired, {} skipped",
                             report.counts.loaded, report.counts.repaired, report.counts.skipped));
    constexpr std::size_t kShown = 20;
    for (std::size_t i = 0; i < std::min(kShown, report.diagnostics.size()); ++i)
        console.note(report.diagnostics[i]);
    if (report.diagnostics.size() > kShown) {
        console.note(fmt::format("... and {} more remarks; --json lists them all.",
                                 report.diagnostics.size() - kShown));
    }
}

}  // namespace reflet::cli
