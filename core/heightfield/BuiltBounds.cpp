// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/BuiltBounds.h"

#include <algorithm>
#include <vector>

namespace reflet {
namespace {

constexpr float kStands = 2.5F;  // metres over the ground: a house, not a car or a hedge
constexpr int kBins = 4;         // along the edge of the square that is looked for

/// Columns and rows of cells, the last ones excluded.
struct CellRange {
    int column = 0, row = 0, lastColumn = 0, lastRow = 0;
};

/// Both at the cell's centre: the highest corner of a steep slope is no house.
bool stands(const Heightfield& field, std::size_t cell) {
    const float ground = field.ground[cell], top = field.topCenter[cell];
    return !isMissing(ground) && !isMissing(top) && top - ground >= kStands;
}

Box boundsWithin(const Heightfield& field, const CellRange& range) {
    Box built, all;
    const GridSpec& grid = field.grid;
    for (int j = range.row; j < range.lastRow; ++j) {
        for (int i = range.column; i < range.lastColumn; ++i) {
            const std::size_t cell = grid.index(i, j);
            const float ground = field.ground[cell], top = field.topMax[cell];
            if (isMissing(ground) || isMissing(top)) {
                continue;
            }
            const glm::dvec3 low(grid.xMin(i), grid.yMin(j), double(ground));
            const glm::dvec3 high(low.x + grid.cellSize, low.y + grid.cellSize, double(top));
            all.add(low);
            all.add(high);
            if (stands(field, cell)) {
                built.add(low);
                built.add(high);
            }
        }
    }
    return built.empty() ? all : built;
}

}  // namespace

Box builtBounds(const Heightfield& field) {
    return boundsWithin(field, {0, 0, field.grid.columns, field.grid.rows});
}

Box busiestBounds(const Heightfield& field, double edge) {
    const GridSpec& grid = field.grid;
    const int bin = std::max(1, int(edge / grid.cellSize / kBins));
    const int columns = (grid.columns + bin - 1) / bin, rows = (grid.rows + bin - 1) / bin;
    if (columns <= kBins && rows <= kBins) {
        return builtBounds(field);
    }
    std::vector<int> count(std::size_t(columns) * std::size_t(rows), 0);
    const auto at = [&](int i, int j) -> int& {
        return count[std::size_t(j) * std::size_t(columns) + std::size_t(i)];
    };
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            at(i / bin, j / bin) += stands(field, grid.index(i, j)) ? 1 : 0;
        }
    }
    int most = -1;
    CellRange best;
    for (int j = 0; j < std::max(1, rows - kBins + 1); ++j) {
        for (int i = 0; i < std::max(1, columns - kBins + 1); ++i) {
            const int lastI = std::min(columns, i + kBins), lastJ = std::min(rows, j + kBins);
            int sum = 0;
            for (int b = j; b < lastJ; ++b) {
                for (int a = i; a < lastI; ++a) {
                    sum += at(a, b);
                }
            }
            if (sum > most) {
                most = sum;
                best = {i * bin, j * bin, std::min(grid.columns, lastI * bin),
                        std::min(grid.rows, lastJ * bin)};
            }
        }
    }
    return boundsWithin(field, best);
}

}  // namespace reflet
