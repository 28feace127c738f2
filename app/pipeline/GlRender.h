// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Render.h"

namespace reflet {

/// renderPicture() with OpenGL: the same view, drawn by core/gpu/SceneRenderer at the project's
/// exposure. Uses a context without a window, made for the calling thread when it is first needed
/// and kept for its next pictures; another context that is current on the thread is no longer so
/// afterwards. ResourceLimit, with a remedy, where there is no OpenGL 4.5.
[[nodiscard]] Result<DisplayImage> renderPictureGl(PreparedCity& city, const RemSet& rems,
                                                   const std::vector<PlacedReflector>& reflectors,
                                                   const Camera& camera,
                                                   const RenderOptions& options,
                                                   const JobContext& job);

/// Method::Rerender at a frame position: the city drawn into the six faces of a cube. As above.
[[nodiscard]] Result<LocalEnvironmentMap> rerenderMap(const PreparedCity& city,
                                                      const glm::dvec3& position,
                                                      const JobContext& job);

}  // namespace reflet
