// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/pictures/Snapshot.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/Render.h"
#include "app/shell/scene/CompareController.h"
#include "core/gpu/GlContext.h"
#include "core/gpu/SceneRenderer.h"
#include "widgets/viewport/Viewport.h"

#include <algorithm>

namespace reflet {
namespace {

constexpr int kQuickSamples = 2;  // squared a pixel

/// Left of the wipe from one picture, right of it from the other.
DisplayImage joined(DisplayImage left, const DisplayImage& right, float wipe) {
    const int border = std::clamp(int(wipe * float(left.width)), 0, left.width);
    for (int y = 0; y < left.height; ++y) {
        const auto row = std::ptrdiff_t(y) * left.width;
        std::copy(right.pixels.begin() + row + border, right.pixels.begin() + row + left.width,
                  left.pixels.begin() + row + border);
    }
    return left;
}

}  // namespace

Snapshot takeSnapshot(const Workbench& bench, const CompareController& compare) {
    Snapshot snapshot;
    const LiveCity& live = *bench.live;
    snapshot.project = bench.document->project();
    snapshot.prepared = live.prepared();
    snapshot.city = live.city();
    snapshot.lighting = live.lighting();
    snapshot.ambient = live.ambient();
    snapshot.rems = live.rems();
    FrameRequest& frame = snapshot.frame;
    frame.camera = bench.viewport->camera();
    frame.exposure = snapshot.project.exposure;
    frame.tuning = snapshot.project.tuning;
    frame.method = compare.left();
    frame.right = compare.right();
    frame.wipe = bench.viewport->wipe();
    frame.given = live.referenceMaps();
    if (const auto traffic = live.traffic()) {
        frame.reflectors = traffic->at(bench.viewport->time());
    }
    return snapshot;
}

Result<DisplayImage> drawQuickly(const Snapshot& snapshot, const JobContext& job) {
    auto context = GlContext::createHeadless();
    if (!context) {
        return tl::unexpected(context.error());
    }
    auto renderer = SceneRenderer::create();
    if (!renderer) {
        return tl::unexpected(renderer.error());
    }
    SceneRenderer& scene = **renderer;
    scene.setCity(snapshot.city);
    scene.setLighting(snapshot.lighting);
    scene.setAmbient(snapshot.ambient);
    scene.setRems(snapshot.rems);
    if (job.cancelled()) {
        return tl::unexpected(JobContext::cancelledError());
    }
    FrameRequest frame = snapshot.frame;
    frame.samplesPerEdge = kQuickSamples;
    return scene.drawImage(frame);
}

Result<DisplayImage> drawBest(const Snapshot& snapshot, const JobContext& job) {
    const PreparedCity& city = *snapshot.prepared;
    const FrameRequest& frame = snapshot.frame;
    RenderOptions options;
    options.width = frame.width;
    options.height = frame.height;
    const double middle = frame.right ? 0.5 : 1.0;
    auto draw = [&](Method method, double from, double to) -> Result<DisplayImage> {
        options.method = method;
        auto picture = renderPicture(city, snapshot.rems, frame.reflectors, frame.camera, options,
                                     job.phase("picture", from, to));
        if (!picture) {
            return tl::unexpected(picture.error());
        }
        return toDisplayImage(*picture, frame.exposure);
    };
    auto left = draw(frame.method, 0.0, middle);
    if (!left || !frame.right) {
        return left;
    }
    const auto right = draw(*frame.right, middle, 1.0);
    if (!right) {
        return tl::unexpected(right.error());
    }
    return joined(std::move(*left), *right, frame.wipe);
}

}  // namespace reflet
