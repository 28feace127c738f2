// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Render.h"
#include "core/gpu/Frame.h"

namespace reflet {

/// The city, in its light, drawn by core/gpu/SceneRenderer as the request says. Uses a context
/// without a window, made for the calling thread when it is first needed and kept for its next
/// pictures; another context that is current on the thread is no longer so afterwards.
/// ResourceLimit, with a remedy, where there is no OpenGL 4.5.
[[nodiscard]] Result<DisplayImage> drawFrame(const PreparedCity& city, const RemSet& rems,
                                             const FrameRequest& frame, const JobContext& job);

/// Frees what drawFrame() keeps for the calling thread.
void releaseGlStage();

/// renderPicture() with OpenGL, by drawFrame(): the same view at the project's exposure.
[[nodiscard]] Result<DisplayImage> renderPictureGl(const PreparedCity& city, const RemSet& rems,
                                                   const std::vector<PlacedReflector>& reflectors,
                                                   const Camera& camera,
                                                   const RenderOptions& options,
                                                   const JobContext& job);

/// Method::Rerender at a frame position: the city drawn into the six faces of a cube. Resources as
/// above.
[[nodiscard]] Result<LocalEnvironmentMap> rerenderMap(const PreparedCity& city,
                                                      const glm::dvec3& position,
                                                      const JobContext& job);

/// A reference map at a frame position, drawn by core/gpu/city/CityBaker. Resources as above; a
/// face that is too large for OpenGL is another ResourceLimit.
[[nodiscard]] Result<ReferenceEnvironmentMap> drawReferenceMap(const PreparedCity& city,
                                                               const std::string& id,
                                                               const glm::dvec3& position,
                                                               const BakeSettings& settings,
                                                               const JobContext& job);

}  // namespace reflet
