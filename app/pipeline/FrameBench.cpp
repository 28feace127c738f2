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

constexpr int kWarmUp = 4;         // pictures before the first that counts
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
struct Samples {
    std::vector<double> all, cpu, city, maps, vehicles, overlays, triangles, localMaps;

    void add(const Took& took, const FrameStatistics& s) {
        all.push_back(took.wall);
        cpu.push_back(took.processor);
        city.push_back(s.city);
        maps.push_back(s.maps);
        vehicles.push_back(s.bodies);
        overlays.push_back(s.overlays);
        triangles.push_back(double(s.triangles));
        localMaps.push_back(double(s.localMaps));
    }
    [[nodiscard]] FrameCosts costs(double scale) const {
        return {scale,
                share(all, 0.5),
                share(all, 0.95),
                share(cpu, 0.5),
                share(city, 0.5),
                share(maps, 0.5),
                share(vehicles, 0.5),
                share(overlays, 0.5),
                std::size_t(share(triangles, 0.5)),
                std::size_t(share(localMaps, 0.5))};
    }
};

class Bench {
public:
    Bench(SceneRenderer& renderer, const PreparedCity& city, const Traffic& traffic,
          const FrameBenchOptions& options, const JobContext& job)
        : m_renderer(renderer), m_traffic(traffic), m_options(options), m_job(job) {
        m_request.exposure = city.project().exposure;
        m_request.tuning = city.project().tuning;
    }

    /// camera: for the n-th picture of a row.
    [[nodiscard]] FrameBenchScene scene(const std::string& name, double start,
                                        const std::function<Camera(int)>& camera) {
        m_start = start;
        m_camera = camera;
        FrameBenchScene scene;
        scene.name = name;
        scene.full = row(1.0);
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
    FrameBenchReport report{(*context)->renderer(), {}};
    Bench bench(**renderer, city, traffic, options, job);
    report.scenes.push_back(
        bench.scene("orbit", start, [&](int i) { return orbiting(middle, i); }));
    report.scenes.push_back(bench.scene("pavement", start, [&](int) { return pavement; }));
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    return report;
}

}  // namespace reflet
