// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/osm/OsmImporter.h"

#include "importers/common/CityBuilder.h"
#include "importers/extrusion/Building.h"
#include "importers/extrusion/Lengths.h"
#include "importers/osm/OsmBuildings.h"
#include "importers/osm/OsmHeights.h"
#include "importers/osm/OsmReader.h"
#include "importers/osm/OsmTrees.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

namespace reflet {

namespace {

using namespace importers;
using extrusion::Building;

constexpr std::size_t kInAPiece = 8192;

bool isShown(const osm::Tags& tags) {
    return osm::isBuilding(tags) || osm::isBuildingPart(tags);
}

Extent extentOf(const std::vector<Building>& buildings, const std::vector<trees::Tree>& trees) {
    Extent extent;
    for (const trees::Tree& tree : trees) {
        if (tree.place)
            extent.add(glm::dvec3(*tree.place, 0.0));
    }
    for (const Building& building : buildings) {
        for (const PlanPolygon& polygon : building.polygons) {
            for (const glm::dvec2& p : polygon.rings.front())
                extent.add(glm::dvec3(p, 0.0));
        }
    }
    return extent;
}

/// Hands the buildings to the builder, parts together with what they are part of.
Result<void> addPieces(CityBuilder& builder, std::vector<Building> buildings,
                       const extrusion::MetricScale& metres, const JobContext& job) {
    const std::size_t count = buildings.size();
    std::size_t next = 0;
    do {
        std::size_t end = std::min(count, next + kInAPiece);
        while (end < count && !buildings[end].outline.parentIds.empty())
            ++end;
        const auto begin = buildings.begin();
        std::vector<Building> part(std::make_move_iterator(begin + std::ptrdiff_t(next)),
                                   std::make_move_iterator(begin + std::ptrdiff_t(end)));
        auto added =
            builder.add(pieceOf(builder, std::move(part), metres), JobContext({}, job.stopToken()));
        if (!added)
            return added;
        next = end;
        job.progress(double(next) / double(std::max<std::size_t>(count, 1)));
    } while (next < count);
    return {};
}

Result<void> addTrees(CityBuilder& builder, std::vector<trees::Tree> trees,
                      const extrusion::MetricScale& metres, const JobContext& job) {
    const double height = builder.options().defaultHeight.value_or(trees::kUnknownHeight);
    for (std::size_t next = 0; next < trees.size(); next += kInAPiece) {
        const auto begin = trees.begin() + std::ptrdiff_t(next);
        const auto end = trees.begin() + std::ptrdiff_t(std::min(trees.size(), next + kInAPiece));
        std::vector<trees::Tree> some(std::make_move_iterator(begin), std::make_move_iterator(end));
        auto added = builder.add(trees::pieceOf(builder, std::move(some), height, metres),
                                 JobContext({}, job.stopToken()));
        if (!added)
            return added;
    }
    return {};
}

void accountForTrees(CityBuilder& builder, const osm::OsmTrees& found, std::size_t count) {
    if (found.heightAssumed + found.crownAssumed == 0)
        return;
    builder.fileDiagnostics().push_back(
        {Severity::Info, "tree-size-assumed", "",
         fmt::format("of {} trees {} say nothing of their height, {} nothing of their crown: what "
                     "is missing was filled in",
                     count, found.heightAssumed, found.crownAssumed),
         "Add the city's own register of trees, which knows more, and leave these out with "
         "--types."});
}

Result<void> account(CityBuilder& builder, const osm::OsmTally& tally, double defaultHeight,
                     const std::string& subject) {
    const auto note = [&](Severity severity, const char* code, std::string text,
                          const char* remedy) {
        builder.fileDiagnostics().push_back({severity, code, "", std::move(text), remedy});
    };
    note(Severity::Info, "credit", "the data are © OpenStreetMap contributors, under the ODbL 1.0",
         "Name them wherever you show pictures of this city.");
    if (tally.unreadable > 0)
        note(Severity::Warning, "height-unreadable",
             fmt::format("{} buildings have a height or a number of levels that means nothing",
                         tally.unreadable),
             "");
    if (tally.unknownRoofs > 0)
        note(Severity::Info, "roof-unknown",
             fmt::format("{} roofs have a shape that is drawn flat", tally.unknownRoofs), "");
    if (tally.assumed == 0)
        return {};
    const std::string text = fmt::format(
        "{} of {} buildings say nothing of their height: {:g} m was taken, {:g} m for "
        "garages and the like",
        tally.assumed, tally.buildings, defaultHeight, extrusion::kStorey);
    if (builder.options().strict)
        return fail(ErrorCode::Refused, text + ", which --strict does not allow", subject,
                    "Import without --strict.");
    note(Severity::Warning, "height-assumed", text,
         "Give another height with --default-height, or where the window shows the model.");
    return {};
}

Result<Imported<CityImport>> run(Purpose purpose, const osm::OsmSource& source, std::size_t bytes,
                                 const ImportOptions& options, const JobContext& job) {
    auto data =
        osm::readOsm(source, {isShown, isShown, osm::isTree}, job.phase("reading", 0.0, 0.5));
    if (!data)
        return tl::unexpected(data.error());
    const double height = options.defaultHeight.value_or(extrusion::kUnknownHeight);
    osm::OsmBuildings found = osm::buildingsOf(*data, height, job.phase("buildings", 0.5, 0.7));
    osm::OsmTrees trees = osm::treesOf(*data);
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    *data = {};
    CityBuilder builder(purpose, source.path, options, bytes);
    const auto degrees = Crs::parse("EPSG:4326");
    if (!degrees)
        return tl::unexpected(degrees.error());
    builder.crsIsOfFormat();
    auto placed =
        builder.place("EPSG:4326", AxisOrder::Settled, extentOf(found.buildings, trees.trees));
    if (!placed)
        return tl::unexpected(placed.error());
    const extrusion::MetricScale metres(*degrees);
    const std::size_t treeCount = trees.trees.size();
    auto added =
        addPieces(builder, std::move(found.buildings), metres, job.phase("building", 0.7, 0.95));
    if (added)
        added = addTrees(builder, std::move(trees.trees), metres, job.phase("trees", 0.95, 1.0));
    if (!added)
        return tl::unexpected(added.error());
    accountForTrees(builder, trees, treeCount);
    if (auto told = account(builder, found.tally, height, source.path.string()); !told)
        return tl::unexpected(told.error());
    auto result = builder.finish();
    if (result) {
        result->value.summary.format = "OpenStreetMap";
        result->value.summary.version = "0.6";
    }
    return result;
}

Result<Imported<CityImport>> runFile(Purpose purpose, const std::filesystem::path& path,
                                     const ImportOptions& options, const JobContext& job) {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(path, failed);
    if (!failed && size > options.maxFileBytes)
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("is larger than the limit of {} bytes", options.maxFileBytes),
                    path.string(), "Cut out the part that you need, e.g. with osmium extract.");
    return run(purpose, {path}, failed ? 0 : std::size_t(size), options, job);
}

}  // namespace

Result<Imported<CityImport>> importOsm(const std::filesystem::path& path,
                                       const ImportOptions& options, const JobContext& job) {
    return runFile(Purpose::Import, path, options, job);
}

Result<Imported<CityImport>> importOsmBytes(std::string_view bytes,
                                            const std::filesystem::path& name,
                                            const ImportOptions& options, const JobContext& job) {
    if (bytes.empty())
        return fail(ErrorCode::Unreadable, "is empty", name.string(), "Download it again.");
    return run(Purpose::Import, {name, bytes}, bytes.size(), options, job);
}

Result<Imported<SourceSummary>> inspectOsm(const std::filesystem::path& path,
                                           const ImportOptions& options, const JobContext& job) {
    return summaryOnly(runFile(Purpose::Inspect, path, options, job));
}

}  // namespace reflet
