// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/gpu/FrameTargets.h"
#include "core/gpu/base/Program.h"
#include "core/gpu/overlay/OverlayShapes.h"
#include "core/gpu/reflection/BodyPass.h"
#include "core/gpu/reflection/RemStore.h"

#include <memory>
#include <span>

namespace reflet {

/// Draws what helps people to work over the finished picture: probes, routes, handles, the place of
/// a tool, the heightfield, the outline of a vehicle. What the city hides shows through faintly.
class OverlayPass {
public:
    [[nodiscard]] static Result<std::unique_ptr<OverlayPass>> create();

    /// For the relief and the feet of the probes; null = none.
    void setHeightfield(std::shared_ptr<const Heightfield> field);

    struct Scene {
        Camera camera;
        float exposure = 1.0F;
        float scale = 1.0F;                   ///< FrameRequest::scale
        const RemSet* rems = nullptr;         ///< for balls that mirror their own map
        RemStore* store = nullptr;            ///< where those maps are
        std::span<const DrawnBody> outlined;  ///< bodies of the selected reflector
    };
    /// Draws over targets.display(), hidden by targets.depth().
    void draw(const Overlays& overlays, const Scene& scene, FrameTargets& targets);

private:
    OverlayPass() = default;
    void drawRelief(const CityView& view, const FrameTargets& targets);
    void drawTriangles(const OverlayShapes& shapes, const CityView& view,
                       const FrameTargets& targets);
    void drawBalls(const OverlayShapes& shapes, const Scene& scene, const CityView& view,
                   const FrameTargets& targets);
    void drawOutline(const Scene& scene, const CityView& view, const FrameTargets& targets);
    void setView(const Program& program, const CityView& view, const FrameTargets& targets) const;

    Program m_flat, m_ball, m_relief, m_mask, m_outline;
    VertexArray m_noAttributes, m_array;
    Buffer m_vertices;
    Framebuffer m_maskFramebuffer;
    Texture m_maskTexture, m_heights, m_noMap;
    std::shared_ptr<const Heightfield> m_field;
};

}  // namespace reflet
