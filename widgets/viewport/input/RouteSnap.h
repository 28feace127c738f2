// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "widgets/viewport/camera/ViewGeometry.h"

#include <glm/vec3.hpp>

#include <vector>

namespace reflet {

/// A place, moved in the plan to the nearest corner of the routes (or point of their lines) within
/// a few pixels of it; the place itself when there is none.
[[nodiscard]] glm::dvec3 snappedToCorners(const std::vector<RouteGlyph>& routes,
                                          const ViewGeometry& view, const glm::dvec3& place);
[[nodiscard]] glm::dvec3 snappedToLines(const std::vector<RouteGlyph>& routes,
                                        const ViewGeometry& view, const glm::dvec3& place);

}  // namespace reflet
