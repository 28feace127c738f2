// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/GlRender.h"

#include "core/gpu/GlContext.h"
#include "core/gpu/SceneRenderer.h"

#include <chrono>

namespace reflet {

namespace {

/// A renderer with a context of its own, and what it shows.
class GlStage {
public:
    /// That of the calling thread, current; made at the first call. The city and its soft light are
    /// uploaded, if they are not those that it shows.
    [[nodiscard]] static Result<SceneRenderer*> showing(const PreparedCity& city,
                                                        const JobContext& job) {
        thread_local std::unique_ptr<GlStage> stage;
        if (!stage) {
            auto context = GlContext::createHeadless();
            if (!context)
                return tl::unexpected(context.error());
            auto renderer = SceneRenderer::create();
            if (!renderer)
                return tl::unexpected(renderer.error());
            stage.reset(new GlStage(std::move(*context), std::move(*renderer)));
        }
        if (auto current = stage->m_context->makeCurrent(); !current)
            return tl::unexpected(current.error());
        if (auto shown = stage->show(city, job); !shown)
            return tl::unexpected(shown.error());
        return stage->m_renderer.get();
    }

private:
    GlStage(std::unique_ptr<GlContext> context, std::unique_ptr<SceneRenderer> renderer)
        : m_context(std::move(context)), m_renderer(std::move(renderer)) {}

    [[nodiscard]] Result<void> show(const PreparedCity& city, const JobContext& job) {
        const auto drawn = city.drawn(job);
        if (!drawn)
            return tl::unexpected(drawn.error());
        const auto ambient = city.ambient(job);
        if (!ambient)
            return tl::unexpected(ambient.error());
        if (*drawn != m_city)
            m_renderer->setCity(*drawn);
        if (!(m_lighting == city.lighting()))
            m_renderer->setLighting(city.lighting());
        if (*ambient != m_ambient)
            m_renderer->setAmbient(*ambient);
        m_city = *drawn;
        m_lighting = city.lighting();
        m_ambient = *ambient;
        return {};
    }

    std::unique_ptr<GlContext> m_context;
    std::unique_ptr<SceneRenderer> m_renderer;  // destroyed before its context
    std::shared_ptr<const DrawnCity> m_city;
    std::shared_ptr<const AmbientVolume> m_ambient;
    Lighting m_lighting;  // the renderer's own at first
};

/// Ray traced maps of all bodies, as Method::RayTrace wants them.
Result<GivenMaps> tracedMaps(const PreparedCity& city,
                             const std::vector<PlacedReflector>& reflectors,
                             const JobContext& job) {
    const auto scene = city.scene(job);
    if (!scene)
        return tl::unexpected(scene.error());
    GivenMaps given;
    for (const PlacedReflector& reflector : reflectors) {
        for (std::size_t i = 0; i < reflector.poses.size(); ++i) {
            auto map =
                reconstruct(city, {}, &**scene, Method::RayTrace, reflector.mapCenter(i), job);
            if (!map)
                return tl::unexpected(map.error());
            given[reflector.id].push_back(
                std::make_shared<const LocalEnvironmentMap>(std::move(*map)));
        }
    }
    return given;
}

}  // namespace

Result<DisplayImage> renderPictureGl(PreparedCity& city, const RemSet& rems,
                                     const std::vector<PlacedReflector>& reflectors,
                                     const Camera& camera, const RenderOptions& options,
                                     const JobContext& job) {
    const auto renderer = GlStage::showing(city, job);
    if (!renderer)
        return tl::unexpected(renderer.error());
    FrameRequest request;
    request.width = options.width;
    request.height = options.height;
    request.samplesPerEdge = options.samplesPerEdge;
    request.camera = camera;
    request.exposure = city.project().exposure;
    request.reflectors = reflectors;
    request.tuning = city.project().tuning;
    request.method = options.method;
    if (options.method == Method::RayTrace) {
        auto given = tracedMaps(city, reflectors, job);
        if (!given)
            return tl::unexpected(given.error());
        request.given = std::move(*given);
    }
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    (*renderer)->setRems(rems);
    return (*renderer)->drawImage(request);
}

Result<LocalEnvironmentMap> rerenderMap(const PreparedCity& city, const glm::dvec3& position,
                                        const JobContext& job) {
    const auto renderer = GlStage::showing(city, job);
    if (!renderer)
        return tl::unexpected(renderer.error());
    const auto start = std::chrono::steady_clock::now();
    LocalEnvironmentMap map =
        (*renderer)->localMap(Method::Rerender, position, city.project().tuning);
    map.statistics.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return map;
}

}  // namespace reflet
