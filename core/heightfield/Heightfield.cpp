// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/Heightfield.h"

#include <algorithm>
#include <array>

namespace reflet {

namespace {

/// One of the two cells whose centres enclose a coordinate, with its linear weight.
struct AxisWeight {
    int index = 0;
    double weight = 0.0;
};

/// Linear weights of the two cell centres around `u`, a coordinate in cells from the grid's edge.
/// Beyond the outermost centres the nearest one holds.
std::array<AxisWeight, 2> centerWeights(double u, int count) {
    const double lower = std::floor(u - 0.5);
    const double fraction = u - 0.5 - lower;
    const int last = count - 1;
    return {{{std::clamp(int(lower), 0, last), 1.0 - fraction},
             {std::clamp(int(lower) + 1, 0, last), fraction}}};
}

}  // namespace

float Heightfield::standingTop(std::size_t cell) const {
    const auto column = centerSpans.at(cell);
    return column.empty() ? topCenter[cell] : column.front().high;
}

std::optional<HeightSpan> Heightfield::overhead(std::size_t cell) const {
    const auto column = spans.at(cell);
    return column.size() < 2 ? std::nullopt : std::optional(column[1]);
}

float Heightfield::groundAt(double x, double y) const {
    const double u = (x - grid.x0) / grid.cellSize;
    const double v = (y - grid.y0) / grid.cellSize;
    if (!(u >= 0.0 && v >= 0.0 && u < grid.columns && v < grid.rows)) {
        return kMissingHeight;
    }
    if (isMissing(ground[grid.index(int(u), int(v))])) {
        return kMissingHeight;
    }
    double sum = 0.0;
    double weights = 0.0;
    for (const AxisWeight& row : centerWeights(v, grid.rows)) {
        for (const AxisWeight& column : centerWeights(u, grid.columns)) {
            const float height = ground[grid.index(column.index, row.index)];
            if (!isMissing(height)) {
                const double weight = row.weight * column.weight;
                sum += weight * double(height);
                weights += weight;
            }
        }
    }
    return float(sum / weights);
}

}  // namespace reflet
