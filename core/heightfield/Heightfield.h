// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/CellSpans.h"
#include "core/math/Geometry.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace reflet {

/// A regular grid of square cells in the project frame. Row 0 is south; cell (i, j) is the
/// half-open square [x0 + i·s, x0 + (i+1)·s) × [y0 + j·s, y0 + (j+1)·s); index = j·columns + i.
struct GridSpec {
    double x0 = 0.0;
    double y0 = 0.0;
    double cellSize = 1.0;  ///< metres
    int columns = 0;
    int rows = 0;

    [[nodiscard]] std::size_t cellCount() const { return std::size_t(columns) * std::size_t(rows); }
    [[nodiscard]] std::size_t index(int i, int j) const {
        return std::size_t(j) * std::size_t(columns) + std::size_t(i);
    }
    [[nodiscard]] bool contains(int i, int j) const {
        return i >= 0 && j >= 0 && i < columns && j < rows;
    }
    [[nodiscard]] int column(double x) const { return int(std::floor((x - x0) / cellSize)); }
    [[nodiscard]] int row(double y) const { return int(std::floor((y - y0) / cellSize)); }
    [[nodiscard]] double xMin(int i) const { return x0 + i * cellSize; }
    [[nodiscard]] double yMin(int j) const { return y0 + j * cellSize; }
    [[nodiscard]] double xMax() const { return x0 + columns * cellSize; }
    [[nodiscard]] double yMax() const { return y0 + rows * cellSize; }

    friend bool operator==(const GridSpec&, const GridSpec&) = default;
};

/// A cell without any surface holds NaN; ask with this, never with ==.
inline constexpr float kMissingHeight = std::numeric_limits<float>::quiet_NaN();
[[nodiscard]] inline bool isMissing(float height) {
    return std::isnan(height);
}

/// Heights of a city seen from above, metres in the project frame, one float per cell and layer.
/// Each may be missing, and topCenter <= topMax wherever both are there.
///
/// - `topMax`: the exact maximum over the closed cell of every surface that counts, rounded up to
///   float32: never below a surface. For skipping, clearance and shadows; as a picture of the city
///   it fattens each wall by up to a cell.
/// - `topCenter`: the upper envelope at the cell's centre: the highest surface right there. Walls
///   (steeper than 89.9 degrees) have no height at a point and do not count, so a building is as
///   wide as its roof; what no centre sees (a lamp post) is in `topMax` only. For hits and display.
/// - `ground`: the terrain at the cell's centre. Where the terrain has a hole, as under most
///   buildings, it is interpolated linearly across the hole.
///
/// A cell whose centre no surface covers shows the interpolated ground in `topCenter`, and a cell
/// that no surface touches shows it in `topMax` as well.
///
/// Most columns are solid from below up to the top. The others (under a bridge, in an arcade,
/// beneath a crown) are told by their solid stretches:
///
/// - `spans`: over the closed cell, conservative like `topMax`: lows rounded down, highs up, so
/// that
///   every point of a surface that counts lies in one. For clearances and for export.
/// - `centerSpans`: at the cell's centre, like `topCenter`. For hits and display.
///
/// The highest stretch ends at the top layer, unless a tunnel (which is not in it) lies higher.
struct Heightfield {
    GridSpec grid;
    std::vector<float> ground;
    std::vector<float> topMax;
    std::vector<float> topCenter;
    CellSpans spans = {};
    CellSpans centerSpans = {};

    /// The top of what stands on the ground at the cell's centre: what is above it hangs over it.
    [[nodiscard]] float standingTop(std::size_t cell) const;
    /// The lowest underside above the ground over the closed cell, where the solid above it ends,
    /// and what that is; nothing for a column without.
    [[nodiscard]] std::optional<HeightSpan> overhead(std::size_t cell) const;

    /// Terrain height under (x, y), bilinear between the cell centres (exact on planes; missing
    /// neighbours are left out). NaN outside the grid and in a cell whose ground is missing.
    [[nodiscard]] float groundAt(double x, double y) const;
};

/// Which of the two top layers a tracer takes its columns from.
enum class TopLayer { Maximum, Center };

}  // namespace reflet
