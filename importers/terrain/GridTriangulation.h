// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/terrain/HeightGrid.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace reflet::terrain {

struct Decimation {
    double error = 0.05;                    ///< metres
    std::size_t mostTriangles = 1'000'000;  ///< more than that: the error grows
};

/// Triangles over the posts of a grid.
struct GridTriangles {
    /// Columns and rows; whole numbers but where a triangle was cut at the grid's rim.
    std::vector<glm::dvec2> places;
    std::vector<double> heights;  ///< of the places
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> block;  ///< of each triangle: the square of 256 by 256 cells
    double error = 0.0;  ///< no post lies further than this above or below the triangles, metres
};

/// Right triangles, halved until no post within lies further from them than the error: small where
/// the ground is rough, large where it is even, without cracks between (Evans, Kirkpatrick and
/// Townsend 2001, "Right-triangulated irregular networks"; here with the true distance of all posts
/// of a triangle in place of that of its split vertex). Where posts are missing there are no
/// triangles: those beside a gap are as small as the grid. A grid of less than two columns or rows
/// gives none. Cancelled.
[[nodiscard]] Result<GridTriangles> triangulateGrid(const HeightGrid& grid,
                                                    const Decimation& decimation,
                                                    const JobContext& job);

/// The height at a place within the cell whose upper left post is (i, j), on the finest triangles:
/// cells are halved between the posts whose column and row have an even sum. u, v in 0..1 from
/// that post; NaN when one of the triangle's three posts is missing.
[[nodiscard]] double finestHeight(const std::array<double, 4>& corners, int i, int j, double u,
                                  double v);

}  // namespace reflet::terrain
