// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/Project.h"

#include <vector>

namespace reflet::samples {

/// A route of a sample's project; points in its CRS.
[[nodiscard]] RouteSpec routeOf(const char* id, const char* name, std::vector<glm::dvec3> points,
                                double cornerRadius = 0.0);

/// A view of a sample's project; eye and target in its CRS, fov in degrees, time in seconds.
[[nodiscard]] View viewOf(const char* name, const char* caption, const glm::dvec3& eye,
                          const glm::dvec3& target, double fov, double time);

}  // namespace reflet::samples
