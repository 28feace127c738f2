// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/PartMesh.h"

#include <vector>

namespace reflet {

/// A body's half given by a net of control points, rows from rear to front, columns from the
/// bottom's middle line around the left side to the top's: a uniform bicubic B-spline surface
/// (curvature continuous, so that reflections flow), continued by its mirror image at y = 0, its
/// first and last row interpolated. Rows that collapse to a line close the body. Reference: de
/// Boor, A Practical Guide to Splines, chapter IX.
struct SplineNet {
    std::vector<std::vector<glm::vec3>> rows;
    int rowSteps = 8;  ///< triangles' rows per span of the net
    int columnSteps = 6;
};

[[nodiscard]] PartMesh splineSurface(const SplineNet& net, std::uint16_t material);

}  // namespace reflet
