// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/frames/SceneDrawer.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace reflet {

namespace {

constexpr double kFollowClearance = 0.4;  // metres over the ground
/// Of the size while there is only the sky: smooth, and it must not keep the city waiting.
constexpr double kSkyScale = 0.25;

Camera cameraOf(const SceneState& state, const std::vector<PlacedReflector>& reflectors) {
    const auto followed = std::find_if(reflectors.begin(), reflectors.end(),
                                       [&](const auto& r) { return r.id == state.followed; });
    if (state.followed.empty() || followed == reflectors.end()) {
        return upright(state.camera);
    }
    const Camera camera = following(*followed, state.followOffset, state.camera.verticalFov);
    return raised(camera, state.ground->heightAt(camera.position.x, camera.position.y),
                  kFollowClearance);
}

/// Before the first probe's picture is taken, the sky stands for what would be black.
Method drawable(Method method, const RemSet& rems) {
    return needsProbes(method) && rems.empty() ? Method::Sky : method;
}

}  // namespace

Result<std::unique_ptr<SceneDrawer>> SceneDrawer::create() {
    Result<std::unique_ptr<SceneRenderer>> renderer = SceneRenderer::create();
    if (!renderer) {
        return tl::unexpected<Error>(renderer.error());
    }
    std::unique_ptr<SceneDrawer> drawer(new SceneDrawer);
    drawer->m_renderer = std::move(*renderer);
    return drawer;
}

std::pair<int, int> SceneDrawer::sizeOf(const SceneState& state, const FramePlan& plan) {
    const bool coarse = !state.city && !plan.settled;
    const double scale = coarse ? std::min(plan.scale, kSkyScale) : plan.scale;
    const auto scaled = [scale](int edge) { return std::max(1, int(std::lround(edge * scale))); };
    return {scaled(state.width), scaled(state.height)};
}

void SceneDrawer::bringUpToDate(const SceneState& state) {
    if (state.city != m_city) {
        m_renderer->setCity(state.city);
        m_city = state.city;
    }
    if (!m_lit || state.lightRevision != m_lightRevision) {
        m_renderer->setLighting(state.lighting);
        m_lightRevision = state.lightRevision;
        m_lit = true;
    }
    if (state.ambient != m_ambient) {
        m_renderer->setAmbient(state.ambient);
        m_ambient = state.ambient;
    }
    if (!(state.rems == m_rems)) {
        m_renderer->setRems(state.rems);
        m_rems = state.rems;
    }
}

DrawnFrame SceneDrawer::draw(const SceneState& state, const FramePlan& plan, unsigned framebuffer) {
    bringUpToDate(state);
    FrameRequest request;
    std::tie(request.width, request.height) = sizeOf(state, plan);
    request.samplesPerEdge = state.city ? plan.samplesPerEdge : 1;
    request.scale = float(plan.scale);
    request.moving = plan.moving;
    request.exposure = state.exposure;
    if (state.traffic) {
        request.reflectors = state.traffic->at(plan.seconds);
    }
    request.camera = cameraOf(state, request.reflectors);
    request.tuning = state.tuning;
    request.method = drawable(state.left, state.rems);
    if (state.right)
        request.right = drawable(*state.right, state.rems);
    request.wipe = state.wipe;
    if (state.given) {
        request.given = *state.given;
    }
    request.overlays = state.overlays;
    if (!state.city) {
        request.reflectors.clear();  // they would float in the sky
    }
    if (!m_cityDrawn) {
        request.overlays = {};  // the city and its vehicles come first
    }

    DrawnFrame frame;
    frame.statistics = m_renderer->draw(request, framebuffer);
    frame.width = request.width;
    frame.height = request.height;
    frame.seconds = plan.seconds;
    frame.camera = request.camera;
    frame.scale = plan.scale;
    frame.settled = plan.settled;
    frame.revision = state.revision();
    m_cityDrawn = state.city != nullptr;
    return frame;
}

}  // namespace reflet
