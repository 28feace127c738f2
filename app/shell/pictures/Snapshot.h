// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"
#include "core/base/JobContext.h"
#include "core/environment/ImageMetrics.h"
#include "core/gpu/Frame.h"

#include <QSize>
#include <memory>

namespace reflet {

class CompareController;
class PreparedCity;

/// Everything that a picture of the present view depends on, as values: it can be drawn on any
/// thread while the user goes on working.
struct Snapshot {
    std::shared_ptr<const PreparedCity> city;  ///< null: there is none
    RemSet rems;
    FrameRequest frame;  ///< without overlays
};

/// size: of the picture. One of another shape shows all that the window shows, and more.
[[nodiscard]] Snapshot takeSnapshot(const Workbench& bench, const CompareController& compare,
                                    const QSize& size);

/// As on the screen, by OpenGL, with smooth edges. ResourceLimit where there is no OpenGL 4.5.
[[nodiscard]] Result<DisplayImage> drawQuickly(const Snapshot& snapshot, const JobContext& job);
/// Ray traced: exact shadows and light; only the vehicles' reflections are by the chosen methods.
[[nodiscard]] Result<DisplayImage> drawBest(const Snapshot& snapshot, const JobContext& job);

}  // namespace reflet
