// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/CoverageFiles.h"

#include "app/pipeline/coverage/CoverageJson.h"
#include "app/pipeline/coverage/CoveragePicture.h"
#include "core/base/Files.h"
#include "core/io/GridFile.h"
#include "core/io/ImageFile.h"
#include "core/io/PlaceTable.h"
#include "core/io/VectorWriter.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace reflet {

namespace {

using Kind = VectorColumn::Kind;

const VectorValue kNone;

/// The attributes that any route has.
std::set<std::string> attributesOf(const CoverageReport& report) {
    std::set<std::string> names;
    for (const RouteCoverage& route : report.routes)
        for (const auto& [name, value] : route.attributes)
            names.insert(name);
    return names;
}

/// A column for an attribute, under a name that none of ours has.
std::string columnOf(const std::string& attribute) {
    return "attr_" + attribute;
}

/// The points of a stretch of a line, at most `step` metres apart.
std::vector<glm::dvec3> pointsOf(const Route& route, const CoveredStretch& stretch,
                                 const glm::dvec3& origin) {
    constexpr double kStep = 2.0;
    const int pieces = std::max(1, int(std::ceil((stretch.to - stretch.from) / kStep)));
    std::vector<glm::dvec3> points;
    for (int k = 0; k <= pieces; ++k)
        points.push_back(origin +
                         route.at(stretch.from + (stretch.to - stretch.from) * k / pieces));
    return points;
}

WrittenLayer stretchLayer(const CoverageReport& report, const glm::dvec3& origin) {
    WrittenLayer layer{"stretches",
                       WrittenLayer::Kind::Lines,
                       {{"route", Kind::Text},
                        {"name", Kind::Text},
                        {"from_m", Kind::Real},
                        {"to_m", Kind::Real},
                        {"coverage", Kind::Real},
                        {"seen", Kind::Real},
                        {"seen_twice", Kind::Real}},
                       {}};
    const std::set<std::string> attributes = attributesOf(report);
    for (const std::string& attribute : attributes)
        layer.columns.push_back({columnOf(attribute), Kind::Text});
    for (const CoveredStretch& stretch : report.stretches) {
        if (stretch.samples == 0)
            continue;
        const DemandLine& line = report.plan.lines[stretch.line];
        const RouteCoverage& route = report.routes[stretch.line];
        VectorShape shape{pointsOf(*line.route, stretch, origin),
                          {route.id, route.name, stretch.from, stretch.to, stretch.coverage,
                           stretch.seen, stretch.seenTwice}};
        for (const std::string& attribute : attributes) {
            const auto found = route.attributes.find(attribute);
            shape.values.push_back(found == route.attributes.end() ? kNone
                                                                   : VectorValue(found->second));
        }
        layer.shapes.push_back(std::move(shape));
    }
    return layer;
}

WrittenLayer worstLayer(const CoverageReport& report) {
    WrittenLayer layer{"worst",
                       WrittenLayer::Kind::Points,
                       {{"rank", Kind::Integer},
                        {"route", Kind::Text},
                        {"name", Kind::Text},
                        {"from_m", Kind::Real},
                        {"to_m", Kind::Real},
                        {"coverage", Kind::Real}},
                       {}};
    std::int64_t rank = 0;
    for (const WorstPlace& place : report.worst)
        layer.shapes.push_back(
            {{place.position},
             {++rank, place.route, place.name, place.from, place.to, place.coverage}});
    return layer;
}

WrittenLayer probeLayer(const CoverageReport& report, const Project& project) {
    WrittenLayer layer{
        "probes",
        WrittenLayer::Kind::Points,
        {{"id", Kind::Text}, {"serves", Kind::Real}, {"loss", Kind::Real}, {"locked", Kind::Yes}},
        {}};
    for (std::size_t k = 0; k < report.probes.size() && k < project.probes.size(); ++k)
        layer.shapes.push_back({{project.probes[k].position},
                                {report.probes[k].id, report.probes[k].serves,
                                 report.probes[k].loss, project.probes[k].locked}});
    return layer;
}

WrittenLayer facadeLayer(const CoverageReport& report, const glm::dvec3& origin) {
    WrittenLayer layer{"facades",
                       WrittenLayer::Kind::Points,
                       {{"coverage", Kind::Real},
                        {"area_m2", Kind::Real},
                        {"wall", Kind::Yes},
                        {"samples", Kind::Integer}},
                       {}};
    for (const SurfacePatch& patch : report.patches)
        layer.shapes.push_back(
            {{origin + patch.middle},
             {patch.coverage, patch.area, patch.wall, std::int64_t(patch.samples)}});
    return layer;
}

WrittenLayer groundLayer(const CoverageReport& report, const PreparedCity& city) {
    WrittenLayer layer{
        "ground", WrittenLayer::Kind::Points, {{"coverage", Kind::Real}, {"seen", Kind::Real}}, {}};
    const CoverageRaster raster = coverageRaster(report);
    for (int j = 0; j < raster.grid.rows; ++j) {
        for (int i = 0; i < raster.grid.columns; ++i) {
            const std::size_t cell = raster.grid.index(i, j);
            if (std::isnan(raster.coverage[cell]))
                continue;
            const double half = 0.5 * raster.grid.cellSize;
            glm::dvec3 middle(raster.grid.xMin(i) + half, raster.grid.yMin(j) + half, 0.0);
            middle.z = city.groundHeight(middle.x, middle.y);
            layer.shapes.push_back({{middle + city.project().frame.origin},
                                    {double(raster.coverage[cell]), double(raster.seen[cell])}});
        }
    }
    return layer;
}

Result<void> writeLayers(const CoverageReport& report, const PreparedCity& city,
                         const std::filesystem::path& path) {
    const Project& project = city.project();
    const glm::dvec3& origin = project.frame.origin;
    std::vector<WrittenLayer> layers{report.plan.ground ? groundLayer(report, city)
                                                        : stretchLayer(report, origin)};
    layers.push_back(worstLayer(report));
    layers.push_back(probeLayer(report, project));
    layers.push_back(facadeLayer(report, origin));
    return writeVector(layers, project.frame, path);
}

Result<void> writeTif(const CoverageReport& report, const ProjectFrame& frame,
                      const std::filesystem::path& path) {
    const CoverageRaster raster = coverageRaster(report);
    const auto band = [](const char* name, const std::vector<float>& values) {
        return GridBand{name, "", [&values](std::size_t cell) { return double(values[cell]); }};
    };
    return writeGrid(raster.grid, {band("coverage", raster.coverage), band("seen", raster.seen)},
                     {false, {{"REFLET_COVERAGE", fmt::format("{:.6f}", report.coverage.mean)}}},
                     frame, path);
}

std::string asTable(const CoverageReport& report) {
    const std::set<std::string> attributes = attributesOf(report);
    std::string out =
        "id,name,length_m,coverage,seen,seen_twice,worst,worst_at_m,p05,largest_gap_m";
    for (const std::string& attribute : attributes)
        out += "," + tableField(columnOf(attribute));
    out += "\n";
    for (const RouteCoverage& route : report.routes) {
        const LineFigures& f = route.figures;
        out += fmt::format("{},{},{:.2f},{:.4f},{:.4f},{:.4f},{:.4f},{:.1f},{:.4f},{:.1f}",
                           tableField(route.id), tableField(route.name), f.length, f.coverage,
                           f.seen, f.seenTwice, f.worst, f.worstStation, f.p05, f.largestGap);
        for (const std::string& attribute : attributes) {
            const auto found = route.attributes.find(attribute);
            out += "," + (found == route.attributes.end() ? "" : tableField(found->second));
        }
        out += "\n";
    }
    return out;
}

}  // namespace

Result<void> writeCoverage(const CoverageReport& report, const PreparedCity& city,
                           const std::filesystem::path& path) {
    const std::string suffix = path.extension().string();
    if (suffix == ".json")
        return writeFileAtomically(path, coverageJson(report, city.project()).dump(2) + "\n");
    if (suffix == ".csv")
        return writeFileAtomically(path, asTable(report));
    if (suffix == ".geojson" || suffix == ".gpkg")
        return writeLayers(report, city, path);
    if (suffix == ".tif" || suffix == ".tiff")
        return writeTif(report, city.project().frame, path);
    if (suffix == ".png") {
        const auto picture = coveragePicture(report, city);
        return picture ? writePng(*picture, path) : tl::unexpected(picture.error());
    }
    return fail(ErrorCode::Usage, "is in no form that coverage is written in", path.string(),
                "End it in .json, .csv, .geojson, .gpkg, .tif or .png.");
}

}  // namespace reflet
