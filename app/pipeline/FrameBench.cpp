// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/FrameBench.h"

#include "app/pipeline/PreparedCity.h"
#include "app/pipeline/Render.h"
#include "core/base/Stopwatch.h"
#include "core/gpu/AdaptiveScale.h"
#include "core/gpu/GlContext.h"
#include "core/gpu/ReadBackTarget.h"
#include "core/gpu/SceneRenderer.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace reflet {

namespace {

constexpr int kWarmUp = 10;        // pictures before the first that counts
constexpr int kSettleAtMost = 24;  // pictures in which the adaptive size finds its step
constexpr int kStillPictures = 3;
constexpr double kStep = 1.0 / 30.0;   // seconds of the drive from picture to picture
constexpr double kOrbitRadius = 70.0;  // metres
constexpr double kOrbitHeight = 35.0;  // metres over what it turns about
constexpr double kOrbitTurn = 0.0175;  // radians from picture to picture: one degree
constexpr double kOrbitFov = 0.8;      // radians
constexpr double kBestMoment = 0.5;    // share of the drive at which the pavement is chosen

double share(std::vector<double> values, double part) {
    if (values.empty())
        return 0.0;
    std::sort(values.begin(), values.end());
    return values[std::size_t(std::lround(part * double(values.size() - 1)))];
}

/// What a picture took, milliseconds.
struct Took {
    double wall = 0.0;
    double processor = 0.0;
};

/// The pictures of one row, as they come.
class Samples {
public:
    void add(const Took& took, const FrameStatistics& s) {
        m_took.push_back(took);
        m_statistics.push_back(s);
    }
    [[nodiscard]] FrameCosts costs(double scale) const {
        const auto wall = [](const Took& t) { return t.wall; };
        const auto stage = [&](double FrameStatistics::*member) {
            return part(m_statistics, 0.5, [=](const FrameStatistics& s) { return s.*member; });
        };
        const auto count = [&](std::size_t FrameStatistics::*member) {
            return std::size_t(part(m_statistics, 0.5,
                                    [=](const FrameStatistics& s) { return double(s.*member); }));
        };
        FrameCosts costs;
        costs.scale = scale;
        costs.median = part(m_took, 0.5, wall);
        costs.p95 = part(m_took, 0.95, wall);
        costs.p99 = part(m_took, 0.99, wall);
        costs.worst = part(m_took, 1.0, wall);
        const auto worst =
            std::max_element(m_took.begin(), m_took.end(),
                             [](const Took& a, const Took& b) { return a.wall < b.wall; });
        if (worst != m_took.end()) {
            costs.worstNumber = int(worst - m_took.begin());
            costs.worstStages = m_statistics[std::size_t(costs.worstNumber)];
        }
        costs.cpu = part(m_took, 0.5, [](const Took& t) { return t.processor; });
        costs.city = stage(&FrameStatistics::city);
        costs.tracing = stage(&FrameStatistics::tracing);
        costs.maps = stage(&FrameStatistics::maps);
        costs.inMaps = stage(&FrameStatistics::inMaps);
        costs.vehicles = stage(&FrameStatistics::bodies);
        costs.overlays = stage(&FrameStatistics::overlays);
        costs.triangles = count(&FrameStatistics::triangles);
        costs.localMaps = count(&FrameStatistics::localMaps);
        costs.lod = lod();
        return costs;
    }

private:
    template <class Item, class Value>
    [[nodiscard]] static double part(const std::vector<Item>& items, double share,
                                     const Value& value) {
        std::vector<double> values;
        for (const Item& item : items)
            values.push_back(value(item));
        return reflet::share(std::move(values), share);
    }
    [[nodiscard]] LodStatistics lod() const {
        LodStatistics out;
        const auto median = [&](auto LodStatistics::*member) {
            return part(m_statistics, 0.5,
                        [=](const FrameStatistics& s) { return double(s.lod.*member); });
        };
        out.on = !m_statistics.empty() && m_statistics.back().lod.on;
        out.coarse = int(median(&LodStatistics::coarse));
        out.allowed = median(&LodStatistics::allowed);
        for (std::size_t LodStatistics::*member :
             {&LodStatistics::full, &LodStatistics::reduced, &LodStatistics::blended,
              &LodStatistics::shared, &LodStatistics::waiting, &LodStatistics::hidden})
            out.*member = std::size_t(median(member));
        return out;
    }

    std::vector<Took> m_took;
    std::vector<FrameStatistics> m_statistics;
};

class Bench {
public:
    Bench(SceneRenderer& renderer, const PreparedCity& city, const Traffic& traffic,
          const FrameBenchOptions& options, const JobContext& job)
        : m_renderer(renderer), m_traffic(traffic), m_options(options), m_job(job) {
        m_request.exposure = city.project().exposure;
        m_request.tuning = city.project().tuning;
        if (options.budget)
            m_request.tuning.lod.frameBudget = *options.budget;
    }
    [[nodiscard]] double budget() const { return m_request.tuning.lod.frameBudget; }

    /// camera: for the n-th picture of a row.
    [[nodiscard]] FrameBenchScene scene(const std::string& name, double start,
                                        const std::function<Camera(int)>& camera) {
        m_start = start;
        m_camera = camera;
        FrameBenchScene scene;
        scene.name = name;
        m_request.tuning.lod.on = true;
        scene.full = row(1.0);
        m_request.tuning.lod.on = false;
        scene.plain = row(1.0);
        m_request.tuning.lod.on = true;
        if (m_options.scale)
            scene.scaled = row(*m_options.scale);
        scene.adaptive = row(settledScale());
        scene.still = still();
        return scene;
    }

private:
    Took draw(int number, double scale, int samples, bool moving, FrameStatistics& statistics) {
        const auto edge = [&](int full) { return std::max(1, int(std::lround(full * scale))); };
        m_request.width = edge(m_options.width);
        m_request.height = edge(m_options.height);
        m_request.scale = float(scale);
        m_request.samplesPerEdge = samples;
        m_request.moving = moving;
        m_request.reflectors = m_traffic.at(m_start + kStep * number);
        m_request.camera = m_camera(number);
        if (!m_target || m_target->width() != m_request.width ||
            m_target->height() != m_request.height)
            m_target.emplace(m_request.width, m_request.height);
        const Stopwatch watch;
        statistics = m_renderer.draw(m_request, m_target->framebuffer());
        static_cast<void>(m_target->read(m_pixels));
        return {1000.0 * watch.seconds(), 1000.0 * watch.cpuSeconds()};
    }

    [[nodiscard]] FrameCosts row(double scale) {
        Samples samples;
        for (int i = 0; i < kWarmUp + m_options.frames && !m_job.cancelled(); ++i) {
            FrameStatistics statistics;
            const Took took = draw(i, scale, 1, true, statistics);
            if (i >= kWarmUp)
                samples.add(took, statistics);
        }
        return samples.costs(scale);
    }

    [[nodiscard]] double settledScale() {
        AdaptiveScale scale(m_options.framesPerSecond);
        for (int i = 0; i < kSettleAtMost && !m_job.cancelled(); ++i) {
            const double at = scale.scale();
            FrameStatistics statistics;
            scale.took(draw(i, at, 1, true, statistics).wall, at);
        }
        return scale.scale();
    }

    [[nodiscard]] FrameCosts still() {
        Samples samples;
        for (int i = 0; i <= kStillPictures && !m_job.cancelled(); ++i) {
            FrameStatistics statistics;
            const Took took = draw(0, 1.0, 2, false, statistics);
            if (i > 0)
                samples.add(took, statistics);
        }
        return samples.costs(1.0);
    }

    SceneRenderer& m_renderer;
    const Traffic& m_traffic;
    const FrameBenchOptions& m_options;
    const JobContext& m_job;
    FrameRequest m_request;
    std::optional<ReadBackTarget> m_target;
    std::vector<std::uint32_t> m_pixels;
    double m_start = 0.0;
    std::function<Camera(int)> m_camera;
};

Camera orbiting(const glm::dvec3& middle, int number) {
    const double angle = kOrbitTurn * number;
    Camera camera;
    camera.target = middle;
    camera.position = middle + glm::dvec3(kOrbitRadius * std::cos(angle),
                                          kOrbitRadius * std::sin(angle), kOrbitHeight);
    camera.verticalFov = kOrbitFov;
    return camera;
}

}  // namespace

Result<FrameBenchReport> benchFrames(const PreparedCity& city, const RemSet& rems,
                                     const Traffic& traffic, const FrameBenchOptions& options,
                                     const JobContext& job) {
    if (traffic.size() == 0) {
        return fail(
            ErrorCode::Usage, "nothing drives in this project", {},
            "Put a vehicle on a route: `reflet-cli edit P.reflet --vehicle t1=tram,ROUTE`.");
    }
    const auto drawn = city.drawn(job);
    if (!drawn)
        return tl::unexpected(drawn.error());
    auto context = GlContext::createHeadless();
    if (!context)
        return tl::unexpected(context.error());
    auto renderer = SceneRenderer::create();
    if (!renderer)
        return tl::unexpected(renderer.error());
    (*renderer)->setCity(*drawn);
    (*renderer)->setLighting(city.lighting());
    (*renderer)->setRems(rems);

    const double start = kBestMoment * traffic.duration();
    const PlacedReflector placed = traffic.at(0, start);
    const Camera pavement = streetCamera(city, placed);
    const glm::dvec3 middle = placed.middle();
    Bench bench(**renderer, city, traffic, options, job);
    FrameBenchReport report{(*context)->renderer(), bench.budget(), {}};
    report.scenes.push_back(
        bench.scene("orbit", start, [&](int i) { return orbiting(middle, i); }));
    report.scenes.push_back(bench.scene("pavement", start, [&](int) { return pavement; }));
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    return report;
}

}  // namespace reflet
