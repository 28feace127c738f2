// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Reconstruct.h"
#include "app/pipeline/Traffic.h"
#include "core/environment/ImageMetrics.h"

#include <optional>
#include <string>
#include <vector>

namespace reflet {

struct RenderOptions {
    int width = 1280;
    int height = 720;
    int samplesPerEdge = 3;
    Method method = Method::Mem;  ///< everywhere, or left of the wipe
    std::optional<Method> right;  ///< right of the wipe
    float wipe = 0.5F;            ///< share of the width that is left of it
};

/// A view where a pedestrian would stand: 1.6 m above the ground beside the reflector, sun behind,
/// in three-quarter view from the front; elsewhere near by when walls or hedges hide the vehicle
/// from there, or when that is a dark yard. Frame coordinates.
[[nodiscard]] Camera streetCamera(const PreparedCity& city, const PlacedReflector& reflector);

/// How well a pedestrian at `eye` sees the vehicle, 0..1: the share of its flanks that nothing
/// hides, less where there is no sky over the eye. 0 within walls.
[[nodiscard]] double streetSight(const PreparedCity& city, const PlacedReflector& reflector,
                                 const glm::dvec3& eye);

/// A street view of a reflector, named after it, half-way along its route or where near by it is
/// seen better (absolute coordinates).
[[nodiscard]] View streetView(const PreparedCity& city, const Traffic& traffic,
                              std::size_t reflector);

/// The views of a project; for a project that has none, a street view of each reflector as
/// streetView() gives (absolute coordinates, as in the project file).
[[nodiscard]] std::vector<View> viewsOf(const PreparedCity& city, const Traffic& traffic);

/// Draws the city with the traffic as it stands, reflections by the method, or both methods, of
/// the options.
[[nodiscard]] Result<RenderedView> renderPicture(const PreparedCity& city, const RemSet& rems,
                                                 const std::vector<PlacedReflector>& reflectors,
                                                 const Camera& camera, const RenderOptions& options,
                                                 const JobContext& job);

/// The camera of a view in frame coordinates.
[[nodiscard]] Camera cameraOf(const View& view, const ProjectFrame& frame);

/// Radiance to display values at an exposure.
[[nodiscard]] DisplayImage toDisplayImage(const RenderedView& view, float exposure);

}  // namespace reflet
