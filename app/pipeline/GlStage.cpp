// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/GlStage.h"

#include "app/pipeline/GlRender.h"
#include "core/gpu/GlContext.h"

namespace reflet {

namespace {

/// Whether both are drawn alike: PreparedCity wraps the same parts anew at each call.
bool isSame(const DrawnCity& a, const DrawnCity& b) {
    return a.model == b.model && a.looks == b.looks && a.textures == b.textures &&
           a.heightfield == b.heightfield && a.diameter == b.diameter;
}

/// A renderer with a context of its own, and what it shows.
class GlStage {
public:
    static std::unique_ptr<GlStage>& ofThread() {
        thread_local std::unique_ptr<GlStage> stage;
        return stage;
    }

    [[nodiscard]] static Result<SceneRenderer*> showing(const PreparedCity& city,
                                                        const JobContext& job) {
        std::unique_ptr<GlStage>& stage = ofThread();
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
        if (!m_city || !isSame(**drawn, *m_city))
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

}  // namespace

Result<SceneRenderer*> glStage(const PreparedCity& city, const JobContext& job) {
    return GlStage::showing(city, job);
}

void releaseGlStage() {
    GlStage::ofThread().reset();
}

}  // namespace reflet
