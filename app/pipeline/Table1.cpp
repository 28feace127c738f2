// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Table1.h"

#include "app/pipeline/Reconstruct.h"
#include "app/pipeline/TracedAnew.h"
#include "app/pipeline/Traffic.h"
#include "core/base/Median.h"
#include "core/base/ParallelFor.h"
#include "core/base/Stopwatch.h"
#include "core/environment/ImageMetrics.h"
#include "core/gpu/GlContext.h"
#include "core/gpu/ReadBackTarget.h"
#include "core/gpu/SceneRenderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

namespace reflet {

namespace {

constexpr int kWarmUp = 2;            // pictures before the first that counts
constexpr double kStep = 1.0 / 30.0;  // seconds from picture to picture
constexpr double kSpeed = 8.0;        // metres a second
constexpr double kEyeHeight = 4.5;    // metres over the road: above all cars
constexpr double kEyeStation = 0.3;   // share of the first route at which the eye hangs
constexpr double kLookAhead = 60.0;   // metres
constexpr double kFov = 0.8;          // radians

struct ColumnKind {
    Method method;
    bool levelOfDetail;
    std::size_t renderer;  ///< those that keep nothing from picture to picture share one
};
constexpr std::array<ColumnKind, kTable1Columns> kColumns{{{Method::Sky, false, 0},
                                                           {Method::Rerender, false, 0},
                                                           {Method::RayTrace, false, 0},
                                                           {Method::Mem, false, 0},
                                                           {Method::Rerender, true, 1},
                                                           {Method::RayTrace, true, 2},
                                                           {Method::Mem, true, 3}}};
constexpr std::size_t kRenderers = 4;

/// So many cars, spread evenly over all routes.
Result<Traffic> carsOn(const PreparedCity& city, int cars) {
    Project project = city.project();
    const auto routes = int(project.routes.size());
    project.reflectors.clear();
    for (int i = 0; i < cars; ++i) {
        const int route = i % routes;
        const int onRoute = (cars - route + routes - 1) / routes;
        const RouteSpec& spec = project.routes[std::size_t(route)];
        const double length = routeInFrame(spec, project.frame).length();
        Reflector car;
        car.id = fmt::format("car-{}", i + 1);
        car.vehicle = "car";
        car.route = spec.id;
        car.speed = kSpeed;
        car.start = length * (double(i / routes) + 0.5) / double(onRoute);
        project.reflectors.push_back(std::move(car));
    }
    return trafficOf(project, city.folder());
}

/// Over the first route, along it.
Camera overTheRoad(const PreparedCity& city) {
    const Project& project = city.project();
    const Route route = routeInFrame(project.routes.front(), project.frame);
    const double station = kEyeStation * route.length();
    Camera camera;
    camera.position = route.at(station) + glm::dvec3(0.0, 0.0, kEyeHeight);
    camera.target = route.at(station) + kLookAhead * route.tangent(station);
    camera.verticalFov = kFov;
    return camera;
}

/// What the columns of one moment took.
struct Took {
    double milliseconds = 0.0;
    std::size_t maps = 0, rays = 0;
};
using Samples = std::array<std::vector<Took>, kTable1Columns>;

Table1Cells cellsOf(const Samples& samples) {
    Table1Cells cells;
    for (std::size_t column = 0; column < kTable1Columns; ++column) {
        Table1Cell& cell = cells[column];
        std::vector<double> times;
        for (const Took& took : samples[column]) {
            times.push_back(took.milliseconds);
            cell.worst = std::max(cell.worst, took.milliseconds);
            cell.maps += double(took.maps);
            cell.rays += double(took.rays);
        }
        const auto count = double(times.size());
        cell.median = median(std::move(times));
        cell.maps /= count;
        cell.rays /= count;
    }
    return cells;
}

Table1TreeRow treeRowOf(const Samples& with, const Samples& without) {
    Table1TreeRow row;
    row.without = cellsOf(without);
    for (std::size_t column = 0; column < kTable1Columns; ++column) {
        std::vector<double> more;
        for (std::size_t i = 0; i < with[column].size(); ++i)
            more.push_back(with[column][i].milliseconds - without[column][i].milliseconds);
        row.cost[column] = median(std::move(more));
    }
    return row;
}

/// One city, and what draws it.
class Stage {
public:
    /// city, options and job must outlive it.
    [[nodiscard]] static Result<std::unique_ptr<Stage>> create(const PreparedCity& city,
                                                               const RemSet& rems,
                                                               const Table1Options& options,
                                                               const JobContext& job) {
        const auto scene = city.scene(job);
        if (!scene)
            return tl::unexpected(scene.error());
        std::unique_ptr<Stage> stage(new Stage(city, *scene, options, job));
        if (auto prepared = stage->prepare(rems); !prepared)
            return tl::unexpected(prepared.error());
        return stage;
    }

    /// Forgets the maps that were traced for another row.
    void beginRow() {
        m_tracers.clear();
        m_tracers.emplace_back(m_city, *m_scene, false);
        m_tracers.emplace_back(m_city, *m_scene, true);
    }

    /// All columns of a moment.
    [[nodiscard]] Result<std::array<Took, kTable1Columns>> moment(
        const std::vector<PlacedReflector>& reflectors) {
        std::array<Took, kTable1Columns> all;
        for (std::size_t column = 0; column < kTable1Columns; ++column) {
            if (m_job.cancelled())
                return tl::unexpected(JobContext::cancelledError());
            const ColumnKind& kind = kColumns[column];
            auto took = draw(reflectors, kind, m_tracers[kind.levelOfDetail ? 1 : 0]);
            if (!took)
                return tl::unexpected(took.error());
            all[column] = *took;
        }
        return all;
    }

    [[nodiscard]] std::size_t displayed(const std::vector<PlacedReflector>& reflectors) const {
        std::set<std::string> seen;
        for (const BodyInView& body :
             bodiesInView(reflectors, m_camera, m_options.width, m_options.height))
            seen.insert(body.reflector);
        return seen.size();
    }

    /// The same places by all three, one after the other.
    [[nodiscard]] Result<Table1Maps> maps() {
        const auto traffic = carsOn(m_city, m_options.maps);
        if (!traffic)
            return tl::unexpected(traffic.error());
        SceneRenderer& renderer = *m_renderers.front();
        const MemSettings& tuning = m_city.project().tuning;
        const float exposure = m_city.project().exposure;
        std::vector<double> rerender, thinned, raytrace, mem;
        PsnrAccumulator likeness;
        for (const PlacedReflector& car : traffic->at(0.0)) {
            const glm::dvec3 place = car.mapCenter(0);
            // Once for what is made but once, and once that counts.
            for (int turn = 0; turn < 2; ++turn) {
                const double all = renderer.timeLocalMap(Method::Rerender, place, tuning, true);
                const double some = renderer.timeLocalMap(Method::Rerender, place, tuning);
                const double ours = renderer.timeLocalMap(Method::Mem, place, tuning);
                const auto traced =
                    reconstruct(m_city, {}, m_scene.get(), Method::RayTrace, place, m_job);
                if (!traced && traced.error().code == ErrorCode::Refused)
                    break;
                if (!traced)
                    return tl::unexpected(traced.error());
                if (turn == 0) {
                    // The soft light that rays find is kept for good: the first time is anew.
                    raytrace.push_back(traced->statistics.milliseconds);
                    continue;
                }
                rerender.push_back(all);
                thinned.push_back(some);
                mem.push_back(ours);
                likeness.add(
                    displayStrip(renderer.localMap(Method::Mem, place, tuning).radiance, exposure),
                    displayStrip(traced->radiance, exposure));
            }
        }
        return Table1Maps{mem.size(),       median(rerender), median(thinned),
                          median(raytrace), median(mem),      likeness.decibels()};
    }

private:
    Stage(const PreparedCity& city, std::shared_ptr<const RadianceScene> scene,
          const Table1Options& options, const JobContext& job)
        : m_city(city),
          m_scene(std::move(scene)),
          m_options(options),
          m_job(job),
          m_camera(overTheRoad(city)),
          m_target(options.width, options.height) {}

    [[nodiscard]] Result<void> prepare(const RemSet& rems) {
        const auto drawn = m_city.drawn(m_job);
        if (!drawn)
            return tl::unexpected(drawn.error());
        const auto ambient = m_city.ambient(m_job);
        if (!ambient)
            return tl::unexpected(ambient.error());
        for (auto& renderer : m_renderers) {
            auto made = SceneRenderer::create();
            if (!made)
                return tl::unexpected(made.error());
            renderer = std::move(*made);
            renderer->setCity(*drawn);
            renderer->setLighting(m_city.lighting());
            renderer->setAmbient(*ambient);
            renderer->setRems(rems);
        }
        return {};
    }

    [[nodiscard]] Result<Took> draw(const std::vector<PlacedReflector>& reflectors,
                                    const ColumnKind& kind, TracedAnew& tracer) {
        FrameRequest request;
        request.width = m_options.width;
        request.height = m_options.height;
        request.moving = true;
        request.camera = m_camera;
        request.exposure = m_city.project().exposure;
        request.reflectors = reflectors;
        request.tuning = m_city.project().tuning;
        request.tuning.lod.on = kind.levelOfDetail;
        request.tuning.lod.frameBudget = std::numeric_limits<double>::infinity();
        request.method = kind.method;
        const Stopwatch watch;
        Took took;
        if (kind.method == Method::RayTrace) {
            auto given = tracer.maps(
                bodiesInView(reflectors, m_camera, request.width, request.height), m_job);
            if (!given)
                return tl::unexpected(given.error());
            request.given = std::move(*given);
            took.maps = tracer.traced();
        }
        const FrameStatistics drawn =
            m_renderers[kind.renderer]->draw(request, m_target.framebuffer());
        static_cast<void>(m_target.read(m_pixels));
        constexpr double kMilli = 1000.0;
        took.milliseconds = kMilli * watch.seconds();
        if (kind.method != Method::RayTrace && kind.method != Method::Sky) {
            took.maps = drawn.localMaps;
            took.rays = drawn.rays;
        }
        return took;
    }

    const PreparedCity& m_city;
    std::shared_ptr<const RadianceScene> m_scene;
    const Table1Options& m_options;
    const JobContext& m_job;
    Camera m_camera;
    ReadBackTarget m_target;
    std::vector<std::uint32_t> m_pixels;
    std::array<std::unique_ptr<SceneRenderer>, kRenderers> m_renderers;
    std::vector<TracedAnew> m_tracers;  ///< without and with levels of detail
};

/// bare: the stage without trees, or null.
Result<Table1Row> measureRow(int cars, const PreparedCity& city, const Table1Options& options,
                             Stage& stage, Stage* bare, const JobContext& job) {
    const auto traffic = carsOn(city, cars);
    if (!traffic)
        return tl::unexpected(traffic.error());
    Samples with, without;
    const std::array<std::pair<Stage*, Samples*>, 2> stages{{{&stage, &with}, {bare, &without}}};
    for (const auto& [one, samples] : stages) {
        if (one != nullptr)
            one->beginRow();
    }
    std::size_t displayed = 0;
    for (int i = 0; i < kWarmUp + options.frames; ++i) {
        const auto reflectors = traffic->at(kStep * i);
        for (const auto& [one, samples] : stages) {
            if (one == nullptr)
                continue;
            const auto took = one->moment(reflectors);
            if (!took)
                return tl::unexpected(took.error());
            for (std::size_t column = 0; i >= kWarmUp && column < kTable1Columns; ++column)
                (*samples)[column].push_back((*took)[column]);
        }
        if (i >= kWarmUp)
            displayed += stage.displayed(reflectors);
        job.progress(double(i + 1) / double(kWarmUp + options.frames));
    }
    Table1Row row;
    row.cars = cars;
    row.displayed = double(displayed) / double(options.frames);
    row.cells = cellsOf(with);
    if (bare != nullptr)
        row.trees = treeRowOf(with, without);
    return row;
}

}  // namespace

const char* toString(Table1Column column) {
    constexpr std::array<const char*, kTable1Columns> kNames{
        "none", "rerender", "raytrace", "mem", "rerenderLod", "raytraceLod", "memLod"};
    return kNames[std::size_t(column)];
}

Result<Table1Report> measureTable1(const PreparedCity& city, const RemSet& rems,
                                   const Table1Options& options, const JobContext& job,
                                   const DrivenCity* bare) {
    if (city.project().routes.empty() || rems.empty()) {
        return fail(ErrorCode::Usage,
                    rems.empty() ? "the project has no reflection probes"
                                 : "the project has no routes to put cars on",
                    city.project().name,
                    "Take the paper's scene: `reflet-cli sample paper DIR`, then `reflet-cli bench "
                    "table1 DIR/paper.reflet`.");
    }
    auto context = GlContext::createHeadless();
    if (!context)
        return tl::unexpected(context.error());
    Table1Report report;
    report.renderer = (*context)->renderer();
    report.threads = threadLimit();
    report.resolution = city.project().tuning.resolution;
    report.probes = rems.size();
    report.triangles = city.city().triangles.size();
    const auto stage = Stage::create(city, rems, options, job);
    if (!stage)
        return tl::unexpected(stage.error());
    const auto maps = (*stage)->maps();
    if (!maps)
        return tl::unexpected(maps.error());
    report.map = *maps;
    std::unique_ptr<Stage> bareStage;
    if (bare != nullptr) {
        auto made = Stage::create(bare->city, bare->rems.rems, options, job);
        if (!made)
            return tl::unexpected(made.error());
        bareStage = std::move(*made);
        const auto bareMaps = bareStage->maps();
        if (!bareMaps)
            return tl::unexpected(bareMaps.error());
        report.trees = Table1Trees{treesOf(city.city()), *bareMaps};
    }
    for (const int cars : options.cars) {
        auto row = measureRow(cars, city, options, **stage, bareStage.get(), job);
        if (!row)
            return tl::unexpected(row.error());
        report.rows.push_back(std::move(*row));
    }
    return report;
}

}  // namespace reflet
