// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Table1.h"

#include "app/pipeline/Reconstruct.h"
#include "app/pipeline/TracedAnew.h"
#include "app/pipeline/Traffic.h"
#include "core/base/Median.h"
#include "core/base/ParallelFor.h"
#include "core/base/Stopwatch.h"
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

class Bench {
public:
    Bench(const PreparedCity& city, const RadianceScene& scene, const Table1Options& options,
          const JobContext& job)
        : m_city(city),
          m_scene(scene),
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

    [[nodiscard]] Result<Table1Row> row(int cars) {
        const auto traffic = carsOn(m_city, cars);
        if (!traffic)
            return tl::unexpected(traffic.error());
        Samples samples;
        std::array<TracedAnew, 2> tracers{TracedAnew(m_city, m_scene, false),
                                          TracedAnew(m_city, m_scene, true)};
        for (int i = 0; i < kWarmUp + m_options.frames; ++i) {
            const auto reflectors = traffic->at(kStep * i);
            for (std::size_t column = 0; column < kTable1Columns; ++column) {
                if (m_job.cancelled())
                    return tl::unexpected(JobContext::cancelledError());
                auto took = draw(reflectors, kColumns[column],
                                 tracers[kColumns[column].levelOfDetail ? 1 : 0]);
                if (!took)
                    return tl::unexpected(took.error());
                if (i >= kWarmUp)
                    samples.columns[column].push_back(*took);
            }
            if (i >= kWarmUp)
                samples.displayed += displayed(reflectors);
            m_job.progress(double(i + 1) / double(kWarmUp + m_options.frames));
        }
        return summary(cars, samples);
    }

    /// The same places by all three, one after the other.
    [[nodiscard]] Result<Table1Maps> maps() {
        const auto traffic = carsOn(m_city, m_options.maps);
        if (!traffic)
            return tl::unexpected(traffic.error());
        SceneRenderer& renderer = *m_renderers.front();
        const MemSettings& tuning = m_city.project().tuning;
        std::vector<double> rerender, thinned, raytrace, mem;
        for (const PlacedReflector& car : traffic->at(0.0)) {
            const glm::dvec3 place = car.mapCenter(0);
            // Once for what is made but once, and once that counts.
            for (int turn = 0; turn < 2; ++turn) {
                const double all = renderer.timeLocalMap(Method::Rerender, place, tuning, true);
                const double some = renderer.timeLocalMap(Method::Rerender, place, tuning);
                const double ours = renderer.timeLocalMap(Method::Mem, place, tuning);
                const auto traced =
                    reconstruct(m_city, {}, &m_scene, Method::RayTrace, place, m_job);
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
            }
        }
        return Table1Maps{mem.size(), median(rerender), median(thinned), median(raytrace),
                          median(mem)};
    }

private:
    struct Took {
        double milliseconds = 0.0;
        std::size_t maps = 0, rays = 0;
    };
    struct Samples {
        std::array<std::vector<Took>, kTable1Columns> columns;
        std::size_t displayed = 0;
    };

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

    [[nodiscard]] std::size_t displayed(const std::vector<PlacedReflector>& reflectors) const {
        std::set<std::string> seen;
        for (const BodyInView& body :
             bodiesInView(reflectors, m_camera, m_options.width, m_options.height))
            seen.insert(body.reflector);
        return seen.size();
    }

    [[nodiscard]] static Table1Row summary(int cars, const Samples& samples) {
        Table1Row row;
        row.cars = cars;
        for (std::size_t column = 0; column < kTable1Columns; ++column) {
            Table1Cell& cell = row.cells[column];
            std::vector<double> times;
            for (const Took& took : samples.columns[column]) {
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
        row.displayed = double(samples.displayed) / double(samples.columns.front().size());
        return row;
    }

    const PreparedCity& m_city;
    const RadianceScene& m_scene;
    const Table1Options& m_options;
    const JobContext& m_job;
    Camera m_camera;
    ReadBackTarget m_target;
    std::vector<std::uint32_t> m_pixels;
    std::array<std::unique_ptr<SceneRenderer>, kRenderers> m_renderers;
};

}  // namespace

const char* toString(Table1Column column) {
    constexpr std::array<const char*, kTable1Columns> kNames{
        "none", "rerender", "raytrace", "mem", "rerenderLod", "raytraceLod", "memLod"};
    return kNames[std::size_t(column)];
}

Result<Table1Report> measureTable1(const PreparedCity& city, const RemSet& rems,
                                   const Table1Options& options, const JobContext& job) {
    if (city.project().routes.empty() || rems.empty()) {
        return fail(ErrorCode::Usage,
                    rems.empty() ? "the project has no reflection probes"
                                 : "the project has no routes to put cars on",
                    city.project().name,
                    "Take the paper's scene: `reflet-cli sample paper DIR`, then `reflet-cli bench "
                    "table1 DIR/paper.reflet`.");
    }
    const auto scene = city.scene(job);
    if (!scene)
        return tl::unexpected(scene.error());
    auto context = GlContext::createHeadless();
    if (!context)
        return tl::unexpected(context.error());
    Bench bench(city, **scene, options, job);
    if (auto prepared = bench.prepare(rems); !prepared)
        return tl::unexpected(prepared.error());
    Table1Report report;
    report.renderer = (*context)->renderer();
    report.threads = threadLimit();
    report.resolution = city.project().tuning.resolution;
    report.probes = rems.size();
    report.triangles = city.city().triangles.size();
    const auto maps = bench.maps();
    if (!maps)
        return tl::unexpected(maps.error());
    report.map = *maps;
    for (const int cars : options.cars) {
        auto row = bench.row(cars);
        if (!row)
            return tl::unexpected(row.error());
        report.rows.push_back(std::move(*row));
    }
    return report;
}

}  // namespace reflet
