// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"
#include "core/baking/AmbientVolume.h"
#include "core/base/JobContext.h"
#include "core/environment/ImageMetrics.h"
#include "core/gpu/Frame.h"
#include "core/project/Project.h"

#include <memory>

namespace reflet {

class CompareController;
class PreparedCity;

/// Everything that a picture of the present view depends on, as values: it can be drawn on any
/// thread while the user goes on working.
struct Snapshot {
    Project project;
    std::shared_ptr<const PreparedCity> prepared;
    std::shared_ptr<const DrawnCity> city;
    Lighting lighting;
    std::shared_ptr<const AmbientVolume> ambient;
    RemSet rems;
    FrameRequest frame;  ///< without overlays
};

[[nodiscard]] Snapshot takeSnapshot(const Workbench& bench, const CompareController& compare);

/// As on the screen, by OpenGL, with smooth edges. ResourceLimit where there is no OpenGL 4.5.
[[nodiscard]] Result<DisplayImage> drawQuickly(const Snapshot& snapshot, const JobContext& job);
/// Ray traced: exact shadows and light; only the vehicles' reflections are by the chosen methods.
[[nodiscard]] Result<DisplayImage> drawBest(const Snapshot& snapshot, const JobContext& job);

}  // namespace reflet
