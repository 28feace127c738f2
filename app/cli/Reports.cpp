// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Reports.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace reflet::cli {

namespace {

using nlohmann::json;

json optionalText(const std::optional<std::string>& text) {
    return text ? json(*text) : json();
}

json triple(const glm::dvec3& v) {
    return json::array({v.x, v.y, v.z});
}

}  // namespace

json toJson(const FileReport& report) {
    const SourceSummary& s = report.summary;
    json out;
    out["file"] = report.file;
    out["format"] = s.format;
    out["version"] = s.version;
    out["crs"] = {{"horizontal", optionalText(s.crsHorizontal)},
                  {"vertical", optionalText(s.crsVertical)}};
    out["objects"] = s.objects;
    out["byType"] = s.byType;
    out["lods"] = s.lods;
    out["surfaces"] = s.surfaces;
    out["triangles"] = s.triangles;
    out["instances"] = {{"count", s.instances}, {"triangles", s.instanceTriangles}};
    out["vertices"] = s.vertices;
    out["bounds"] = s.bounds.empty()
                        ? json()
                        : json{{"min", triple(s.bounds.min)}, {"max", triple(s.bounds.max)}};
    if (!s.raster.empty()) {
        out["raster"] = json::array();
        for (const RasterSize& raster : s.raster)
            out["raster"].push_back(
                {{"columns", raster.columns}, {"rows", raster.rows}, {"bands", raster.bands}});
    }
    out["textures"] = {{"referenced", s.texturesReferenced}, {"resolved", s.texturesResolved}};
    out["counts"] = {{"loaded", report.counts.loaded},
                     {"repaired", report.counts.repaired},
                     {"skipped", report.counts.skipped}};
    out["diagnostics"] = toJson(report.diagnostics);
    return out;
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
