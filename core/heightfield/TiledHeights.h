// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"

#include <vector>

namespace reflet {

/// Maxima of blocks of 64 × 64 cells, of blocks of 8 × 8 cells, and the cells' own heights, in one
/// array, such that the 64 parts of a block follow one another (8 rows of 8): a walk within a block
/// stays within four cache lines. Missing cells, and what fills the last blocks up, are -infinity.
///
/// The blocks of 64 × 64 come first, row by row. The parts of what lies at n begin at
/// 64·n + blocks(), for both kinds of blocks.
struct TiledHeights {
    GridSpec grid;
    int blockColumns = 0;  ///< of 64 × 64 cells
    int blockRows = 0;
    std::vector<float> maximum;
    double highest = 0.0;    ///< of all; -infinity when every cell is missing
    double magnitude = 0.0;  ///< largest |height|: scale of the rounding margin

    [[nodiscard]] std::size_t blocks() const {
        return std::size_t(blockColumns) * std::size_t(blockRows);
    }
    /// Where the parts of the block or cell at `n` begin.
    [[nodiscard]] std::size_t parts(std::size_t n) const { return 64 * n + blocks(); }
    [[nodiscard]] std::size_t indexOfCell(int i, int j) const;
};

/// layer: heights of the grid's cells, some of them missing.
[[nodiscard]] TiledHeights tiledHeights(const GridSpec& grid, const std::vector<float>& layer);

}  // namespace reflet
