// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/GridLines.h"

#include <array>
#include <atomic>
#include <vector>

namespace reflet {

using TriangleCorners = std::array<glm::dvec3, 3>;

/// One layer that many threads raise at once. The maximum does not depend on the order, so the
/// result has the same bits for any schedule. Starts at -infinity everywhere.
class RisingLayer {
public:
    explicit RisingLayer(const GridSpec& grid)
        : m_columns(std::size_t(grid.columns)), m_heights(grid.cellCount(), -kInfinity) {}

    [[nodiscard]] float at(int i, int j) const {
        return std::atomic_ref(cell(i, j)).load(std::memory_order_relaxed);
    }
    void raise(int i, int j, float height) {
        const std::atomic_ref<float> target(cell(i, j));
        float current = target.load(std::memory_order_relaxed);
        // -0 + 0 is +0: equal heights must not differ in their sign bit.
        while (height > current &&
               !target.compare_exchange_weak(current, height + 0.0F, std::memory_order_relaxed)) {
        }
    }
    /// The heights by GridSpec::index; -infinity where nothing was raised.
    [[nodiscard]] std::vector<float>& heights() { return m_heights; }

private:
    [[nodiscard]] float& cell(int i, int j) const {
        return m_heights[std::size_t(j) * m_columns + std::size_t(i)];
    }

    std::size_t m_columns;
    mutable std::vector<float> m_heights;  ///< atomic_ref wants a mutable object, even to read
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

/// The lines' cells that [from, to] may touch: one wider on each side than the division says.
[[nodiscard]] CellRange touchedCells(const GridLines& lines, double from, double to);
[[nodiscard]] CellRange touchedRows(const GridPlan& plan, const TriangleCorners& triangle);

/// Raises each cell of the rows [rows.first, rows.last) that the closed triangle touches to the
/// exact maximum over the closed cell, rounded up to float32. Vertical triangles and those that
/// have shrunk to a segment or a point count as well.
void raiseMaximum(RisingLayer& layer, const GridPlan& plan, const TriangleCorners& triangle,
                  CellRange rows);

/// Raises each cell of those rows whose centre the closed triangle covers to its plane's height
/// there, rounded to the nearest float32. A centre on an edge that two triangles share is covered
/// by both. Triangles steeper than 89.9 degrees cover no centre.
void raiseCenters(RisingLayer& layer, const GridPlan& plan, const TriangleCorners& triangle,
                  CellRange rows);

/// The smallest float32 that is not below the value.
[[nodiscard]] float roundedUp(double value);
/// The largest float32 that is not above the value.
[[nodiscard]] float roundedDown(double value);

}  // namespace reflet
