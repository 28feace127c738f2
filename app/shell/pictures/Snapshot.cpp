// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/pictures/Snapshot.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/GlRender.h"
#include "app/shell/scene/CompareController.h"
#include "widgets/viewport/Viewport.h"

#include <cmath>

namespace reflet {
namespace {

constexpr int kQuickSamples = 2;  // squared a pixel

/// The same view in a picture of another shape: nothing that was seen is cut off.
Camera fitted(Camera camera, const QSize& shown, const QSize& size) {
    const double wider = double(shown.width()) * size.height();
    const double narrower = double(size.width()) * shown.height();
    if (wider > narrower && narrower > 0.0) {
        camera.verticalFov = 2.0 * std::atan(std::tan(0.5 * camera.verticalFov) * wider / narrower);
    }
    return camera;
}

}  // namespace

Snapshot takeSnapshot(const Workbench& bench, const CompareController& compare, const QSize& size) {
    const LiveCity& live = *bench.live;
    const Project& project = bench.document->project();
    Snapshot snapshot{live.prepared(), live.rems(), {}};
    FrameRequest& frame = snapshot.frame;
    frame.width = size.width();
    frame.height = size.height();
    frame.camera = fitted(bench.viewport->camera(), bench.viewport->size(), size);
    frame.exposure = project.exposure;
    frame.tuning = project.tuning;
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
    FrameRequest frame = snapshot.frame;
    frame.samplesPerEdge = kQuickSamples;
    auto image = drawFrame(*snapshot.city, snapshot.rems, frame, job);
    releaseGlStage();
    return image;
}

Result<DisplayImage> drawBest(const Snapshot& snapshot, const JobContext& job) {
    const FrameRequest& frame = snapshot.frame;
    RenderOptions options;
    options.width = frame.width;
    options.height = frame.height;
    options.method = frame.method;
    options.right = frame.right;
    options.wipe = frame.wipe;
    const auto picture =
        renderPicture(*snapshot.city, snapshot.rems, frame.reflectors, frame.camera, options, job);
    if (!picture) {
        return tl::unexpected(picture.error());
    }
    return toDisplayImage(*picture, frame.exposure);
}

}  // namespace reflet
