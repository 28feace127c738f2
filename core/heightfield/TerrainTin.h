// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/heightfield/TriangleRaster.h"

#include <vector>

namespace reflet {

/// The Delaunay triangles, seen from above, of points in space. Of points with equal x and y the
/// lowest counts (a building stands on the lower side of a step). Independent of the points' order.
/// Empty for fewer than three points or points in one line. Cancelled when the job is.
[[nodiscard]] Result<std::vector<TriangleCorners>> delaunayFromAbove(std::vector<glm::dvec3> points,
                                                                     const JobContext& job);

}  // namespace reflet
