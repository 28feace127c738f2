// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace reflet {

/// Longitude and latitude (WGS 84, degrees) of places (absolute, in the frame's CRS), in their
/// order; nullopt for all of them in a local frame, or where PROJ knows no way there.
[[nodiscard]] std::optional<std::vector<glm::dvec2>> lonLatOf(
    const ProjectFrame& frame, const std::vector<glm::dvec3>& places);

}  // namespace reflet
