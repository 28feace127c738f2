// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/SuggestBench.h"

#include "app/pipeline/Import.h"
#include "app/pipeline/ScratchFolder.h"
#include "app/pipeline/coverage/CoverageWatch.h"
#include "core/base/Files.h"
#include "core/base/Median.h"
#include "core/base/Stopwatch.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace reflet {

namespace {

using nlohmann::json;

constexpr int kBlocks = 12;          // along an edge: 13 streets of 80 m each way
constexpr double kPitch = 80.0;      // metres from street to street
constexpr double kHalfStreet = 8.0;  // metres from its middle to the houses
constexpr double kEast = 690'000.0, kNorth = 5'335'000.0;
constexpr int kMoves = 9;

/// A CityJSON model of boxes on flat ground, in millimetres.
class BoxModel {
public:
    void ground(double low, double high) {
        const json ring{vertex(low, low, 0), vertex(high, low, 0), vertex(high, high, 0),
                        vertex(low, high, 0)};
        m_objects["ground"] = {{"type", "TINRelief"},
                               {"geometry",
                                {{{"type", "CompositeSurface"},
                                  {"lod", "1"},
                                  {"boundaries", json::array({json::array({ring})})}}}}};
    }
    void house(const glm::dvec2& low, const glm::dvec2& high, double height) {
        std::array<int, 8> v{};
        for (int i = 0; i < 8; ++i)
            v[std::size_t(i)] = vertex(i % 4 == 1 || i % 4 == 2 ? high.x : low.x,
                                       i % 4 >= 2 ? high.y : low.y, i >= 4 ? height : 0.0);
        static constexpr std::array<std::array<int, 4>, 6> kFaces{
            {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
        json shell = json::array();
        for (const auto& face : kFaces) {
            json ring = json::array();
            for (const int corner : face)
                ring.push_back(v[std::size_t(corner)]);
            shell.push_back(json::array({ring}));
        }
        m_objects[fmt::format("house-{}", m_houses++)] = {
            {"type", "Building"},
            {"geometry",
             {{{"type", "Solid"}, {"lod", "1"}, {"boundaries", json::array({shell})}}}}};
    }
    [[nodiscard]] std::string text() const {
        return json{
            {"type", "CityJSON"},
            {"version", "2.0"},
            {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {kEast, kNorth, 0.0}}}},
            {"metadata", {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/25832"}}},
            {"CityObjects", m_objects},
            {"vertices", m_vertices}}
            .dump();
    }

private:
    int vertex(double x, double y, double z) {
        m_vertices.push_back(
            {std::lround(x * 1000.0), std::lround(y * 1000.0), std::lround(z * 1000.0)});
        return int(m_vertices.size()) - 1;
    }
    std::vector<std::array<long, 3>> m_vertices;
    json m_objects = json::object();
    int m_houses = 0;
};

/// Houses around the edge of a block, with gaps here and there and a courtyard within.
void addBlock(BoxModel& model, const glm::dvec2& low, std::mt19937& random) {
    constexpr double kDepth = 12.0, kFront = 16.0;
    const double edge = kPitch - 2.0 * kHalfStreet;
    const auto next = [&random] { return double(random() % 1000U) / 1000.0; };
    for (double at = 0.0; at < edge - 1.0; at += kFront) {
        const std::array<std::pair<glm::dvec2, glm::dvec2>, 4> houses{
            {{{at, 0.0}, {at + kFront, kDepth}},
             {{at, edge - kDepth}, {at + kFront, edge}},
             {{0.0, at}, {kDepth, at + kFront}},
             {{edge - kDepth, at}, {edge, at + kFront}}}};
        for (std::size_t side = 0; side < houses.size(); ++side) {
            const bool corner = at < kDepth || at + kFront > edge - kDepth;
            const double height = 8.0 + 18.0 * next();
            const bool gap = next() < 0.12;
            if (!gap && !(side >= 2 && corner))  // the corners belong to the first two rows
                model.house(low + houses[side].first, low + houses[side].second, height);
        }
    }
}

void addStreets(Project& project) {
    const double length = kBlocks * kPitch;
    for (int k = 0; k <= kBlocks; ++k) {
        const glm::dvec3 start(kEast, kNorth, 0.0);
        RouteSpec across, along;
        across.id = fmt::format("across-{}", k);
        across.points = {start + glm::dvec3(0.0, k * kPitch, 0.0),
                         start + glm::dvec3(length, k * kPitch, 0.0)};
        along.id = fmt::format("along-{}", k);
        along.points = {start + glm::dvec3(k * kPitch, 0.0, 0.0),
                        start + glm::dvec3(k * kPitch, length, 0.0)};
        project.routes.push_back(std::move(across));
        project.routes.push_back(std::move(along));
    }
}

Result<PreparedCity> madeCity(const std::filesystem::path& folder, const JobContext& job) {
    ImportRequest request;
    request.files = {folder / "blocks.city.json"};
    if (auto written = writeFileAtomically(request.files.front(), blockCity(kBlocks)); !written)
        return tl::unexpected(written.error());
    auto imported = importProject(request, job);
    if (!imported)
        return tl::unexpected(imported.error());
    addStreets(imported->project);
    PrepareOptions options;
    options.city = std::move(imported->city);
    options.keep = false;
    return PreparedCity::prepare(std::move(imported->project), folder / "blocks.reflet", job,
                                 options);
}

double lengthOf(const CoveragePlan& plan) {
    double length = 0.0;
    for (const DemandLine& line : plan.lines)
        length += line.route->length();
    return length;
}

/// Median seconds of following a probe that moves by half a metre.
double timeMoves(const std::shared_ptr<const PreparedCity>& city, CoveragePlan plan,
                 std::vector<Probe> probes, std::size_t samples) {
    CoverageWatch watch(city, std::move(plan), samples, 0);
    watch.follow(probes);
    std::vector<double> seconds;
    for (int k = 0; k < kMoves && !probes.empty(); ++k) {
        probes[std::size_t(k) * probes.size() / kMoves].position.x += 0.5;
        const Stopwatch stopwatch;
        watch.follow(probes);
        seconds.push_back(stopwatch.seconds());
    }
    return seconds.empty() ? 0.0 : median(seconds);
}

}  // namespace

std::string blockCity(int blocks) {
    BoxModel model;
    model.ground(-40.0, blocks * kPitch + 40.0);
    std::mt19937 random(20031);
    for (int j = 0; j < blocks; ++j)
        for (int i = 0; i < blocks; ++i)
            addBlock(model, glm::dvec2(i * kPitch + kHalfStreet, j * kPitch + kHalfStreet), random);
    return model.text();
}

Result<SuggestBenchReport> benchSuggest(const SuggestBenchOptions& options, const JobContext& job) {
    const ScratchFolder folder;
    if (folder.path().empty())
        return fail(ErrorCode::WriteFailed, "There is no temporary folder to write the city to",
                    "TMPDIR", "Let TMPDIR name a folder that can be written to.");
    const JobContext reading = job.phase("reading the city", 0.0, 0.1);
    auto opened = options.project ? PreparedCity::open(*options.project, reading)
                                  : madeCity(folder.path(), reading);
    if (!opened)
        return tl::unexpected(opened.error());
    const auto city = std::make_shared<const PreparedCity>(std::move(*opened));
    SuggestOptions suggest;
    auto plan = coveragePlan(*city, suggest);
    if (!plan)
        return tl::unexpected(plan.error());
    SuggestBenchReport report;
    report.routes = lengthOf(*plan);
    report.triangles = city->city().triangles.size();
    suggest.count = options.count;
    suggest.most = options.count;
    suggest.mostSamples = options.samples;
    suggest.baselines = false;
    if (!plan->lines.empty())
        suggest.spacing = std::clamp(report.routes / double(options.candidates), 0.5, 1000.0);
    const Stopwatch stopwatch;
    const auto suggestion = suggestProbes(*city, suggest, job.phase("suggesting", 0.1, 0.9));
    if (!suggestion)
        return tl::unexpected(suggestion.error());
    report.seconds = stopwatch.seconds();
    report.candidates = suggestion->candidates;
    report.samples = suggestion->samples;
    report.probes = suggestion->probes.size();
    report.coverage = suggestion->after.mean;
    report.ratio = suggestion->ratio();
    report.moveOne = timeMoves(city, std::move(*plan),
                               withSuggested(city->project(), *suggestion).probes, report.samples);
    return report;
}

}  // namespace reflet
