// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/Project.h"
#include "core/rendering/ViewRenderer.h"
#include "core/traffic/Traffic.h"

#include <vector>

namespace reflet {

/// The vehicles of a project and the routes that they drive, in the project frame. Usage when a
/// reflector names a vehicle that does not exist.
[[nodiscard]] Result<Traffic> trafficOf(const Project& project);

/// The route of a project in the project frame, corners rounded.
[[nodiscard]] Route routeInFrame(const RouteSpec& spec, const ProjectFrame& frame);

/// Meshes of placed bodies in the project frame, kept alive for a scene that has them as occluders.
class BodyGeometry {
public:
    explicit BodyGeometry(const std::vector<PlacedReflector>& reflectors);
    [[nodiscard]] const std::vector<Occluder>& occluders() const { return m_occluders; }
    /// In the order of occluders(); maps are null.
    [[nodiscard]] const std::vector<PlacedBody>& bodies() const { return m_bodies; }

private:
    std::vector<std::vector<glm::vec3>> m_vertices;
    std::vector<Occluder> m_occluders;
    std::vector<PlacedBody> m_bodies;
};

}  // namespace reflet
