// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/SceneRenderer.h"
#include "widgets/viewport/frames/FrameDirector.h"

#include <memory>

namespace reflet {

/// Draws states: keeps a renderer in step with the newest one. Belongs to one OpenGL context, which
/// must be current at every call.
class SceneDrawer {
public:
    [[nodiscard]] static Result<std::unique_ptr<SceneDrawer>> create();

    /// Pixels of the picture that a plan asks for.
    [[nodiscard]] static std::pair<int, int> sizeOf(const SceneState& state, const FramePlan& plan);
    /// Draws into a framebuffer of that size; all of the result but texture and pace is filled.
    [[nodiscard]] DrawnFrame draw(const SceneState& state, const FramePlan& plan,
                                  unsigned framebuffer);

private:
    SceneDrawer() = default;
    void bringUpToDate(const SceneState& state);

    std::unique_ptr<SceneRenderer> m_renderer;
    std::shared_ptr<const DrawnCity> m_city;
    std::shared_ptr<const AmbientVolume> m_ambient;
    RemSet m_rems;
    std::uint64_t m_lightRevision = 0;
    bool m_lit = false;
    bool m_cityDrawn = false;  ///< in the last picture
};

}  // namespace reflet
