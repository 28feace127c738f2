// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/overlay/OverlayPass.h"
namespace reflet {
Result<std::unique_ptr<OverlayPass>> OverlayPass::create() {
    return std::make_unique<OverlayPass>();
}
void OverlayPass::setHeightfield(std::shared_ptr<const Heightfield>) {}
void OverlayPass::draw(const Overlays&, const Camera&, const RemSet&, float, const BodyTargets&,
                       FrameTargets&) {}
}  // namespace reflet
