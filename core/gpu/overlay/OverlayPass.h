// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/gpu/FrameTargets.h"
#include "core/gpu/reflection/BodyPass.h"

#include <memory>

namespace reflet {

class OverlayPass {
public:
    [[nodiscard]] static Result<std::unique_ptr<OverlayPass>> create();
    void setHeightfield(std::shared_ptr<const Heightfield> field);
    void draw(const Overlays& overlays, const Camera& camera, const RemSet& rems, float exposure,
              const BodyTargets& scene, FrameTargets& targets);
};

}  // namespace reflet
