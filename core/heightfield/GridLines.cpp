// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/GridLines.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace reflet {

namespace {

/// A border that a float32 names to a nanometre is that float: then a wall whose vertices were
/// meant to lie on the border does lie on it, though k·0.1 is not what the decimal says. The casts
/// through the bits keep g++ 12 from dropping the rounding (it does in vectorised code).
double snapToFloat(double line) {
    const auto rounded = std::bit_cast<float>(std::bit_cast<std::uint32_t>(float(line)));
    return std::abs(double(rounded) - line) < 1e-9 ? double(rounded) : line;
}

GridLines linesOf(double gridOrigin, double cellSize, int count, double frameOrigin) {
    // With the grid aligned to the CRS, line k of the CRS lies at k·s - phase: a function of k
    // alone. Any other grid is taken as it stands.
    const double phase = gridPhase(frameOrigin, cellSize);
    const double k0 = std::round((gridOrigin + phase) / cellSize);
    const bool aligned = std::abs(k0 * cellSize - phase - gridOrigin) < 1e-6 * cellSize;
    const auto line = [&](double i) {
        return aligned ? (k0 + i) * cellSize - phase : gridOrigin + i * cellSize;
    };
    GridLines lines;
    lines.perCell = 1.0 / cellSize;
    lines.border.reserve(std::size_t(count) + 1);
    lines.center.reserve(std::size_t(count));
    for (int i = 0; i <= count; ++i) {
        lines.border.push_back(snapToFloat(line(i)));
    }
    for (int i = 0; i < count; ++i) {
        lines.center.push_back(line(i + 0.5));
    }
    lines.first = lines.border.front();
    return lines;
}

}  // namespace

double gridPhase(double origin, double cellSize) {
    return std::round(std::remainder(origin, cellSize) * 1e6) / 1e6;
}

GridLines gridColumns(const GridSpec& grid, const ProjectFrame& frame) {
    return linesOf(grid.x0, grid.cellSize, grid.columns, frame.origin.x);
}

GridLines gridRows(const GridSpec& grid, const ProjectFrame& frame) {
    return linesOf(grid.y0, grid.cellSize, grid.rows, frame.origin.y);
}

}  // namespace reflet
