// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/GridLines.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace reflet {

using TriangleCorners = std::array<glm::dvec3, 3>;

/// One layer that is raised. The maximum does not depend on the order, so the result has the same
/// bits for any schedule that leaves each row to one thread at a time. Starts at -infinity
/// everywhere.
class RisingLayer {
public:
    explicit RisingLayer(const GridSpec& grid)
        : m_columns(std::size_t(grid.columns)), m_heights(grid.cellCount(), -kInfinity) {}

    [[nodiscard]] float at(int i, int j) const { return m_heights[index(i, j)]; }
    void raise(int i, int j, float height) {
        float& current = m_heights[index(i, j)];
        // -0 + 0 is +0: equal heights must not differ in their sign bit.
        current = height > current ? height + 0.0F : current;
    }
    /// The heights by GridSpec::index; -infinity where nothing was raised.
    [[nodiscard]] std::vector<float>& heights() { return m_heights; }

private:
    [[nodiscard]] std::size_t index(int i, int j) const {
        return std::size_t(j) * m_columns + std::size_t(i);
    }

    std::size_t m_columns;
    std::vector<float> m_heights;
};

/// Half-open range of rows or columns.
struct CellRange {
    int first = 0;
    int last = 0;
};

/// Both axes of a grid.
struct GridPlan {
    GridLines columns;
    GridLines rows;

    GridPlan(const GridSpec& grid, const ProjectFrame& frame)
        : columns(gridColumns(grid, frame)), rows(gridRows(grid, frame)) {}
};

/// The lines' closed cells that [from, to] touches.
[[nodiscard]] inline CellRange touchedCells(const GridLines& lines, double from, double to) {
    // One wider on each side than the division says, which rounds.
    CellRange range{std::max(0, lines.nearCell(from) - 1),
                    std::min(lines.count(), lines.nearCell(to) + 2)};
    const auto border = [&](int i) { return lines.border[std::size_t(i)]; };
    while (range.first < range.last && border(range.first + 1) < from)
        ++range.first;
    while (range.first < range.last && border(range.last - 1) > to)
        --range.last;
    return range;
}
[[nodiscard]] inline CellRange touchedRows(const GridPlan& plan, const TriangleCorners& triangle) {
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    return touchedCells(plan.rows, low, high);
}

/// Raises each cell of the rows [rows.first, rows.last) that the closed triangle touches to the
/// exact maximum over the closed cell, rounded up to float32. Vertical triangles and those that
/// have shrunk to a segment or a point count as well.
void raiseMaximum(RisingLayer& layer, const GridPlan& plan, const TriangleCorners& triangle,
                  CellRange rows);

/// Raises, in one or two layers, each cell of those rows whose centre the closed triangle covers to
/// its plane's height there, rounded to the nearest float32. A centre on an edge that two triangles
/// share is covered by both. Triangles steeper than 89.9 degrees cover no centre.
void raiseCenters(RisingLayer& layer, RisingLayer* second, const GridPlan& plan,
                  const TriangleCorners& triangle, CellRange rows);

/// The smallest float32 that is not below the finite value. Without a branch: which way a height
/// was rounded is anybody's guess. The casts through the bits keep g++ 12 from dropping the
/// rounding (it does in vectorised code).
[[nodiscard]] inline float roundedUp(double value) {
    const auto nearest = std::bit_cast<std::int32_t>(float(value));
    const bool below = double(std::bit_cast<float>(nearest)) < value;
    // The next float up is the next integer for positive ones, the one before for negative ones.
    return std::bit_cast<float>(nearest + (below ? 1 : 0) * (1 | (nearest >> 31)));
}
/// The largest float32 that is not above the finite value.
[[nodiscard]] inline float roundedDown(double value) {
    return -roundedUp(-value);
}

}  // namespace reflet
