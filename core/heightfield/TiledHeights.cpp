// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TiledHeights.h"

#include "core/base/ParallelFor.h"

#include <algorithm>
#include <cassert>

namespace reflet {

namespace {

constexpr int kEdge = 8;    ///< parts along a block's edge
constexpr int kParts = 64;  ///< of a block; also cells along the edge of a large one

/// Fills the large block at `block`: its 64 x 64 cells, its 64 maxima, its own.
void fillBlock(TiledHeights& tiled, const std::vector<float>& layer, std::size_t block) {
    const GridSpec& grid = tiled.grid;
    const int i0 = int(block % std::size_t(tiled.blockColumns)) * kParts;
    const int j0 = int(block / std::size_t(tiled.blockColumns)) * kParts;
    const int i1 = std::min(i0 + kParts, grid.columns);
    const int j1 = std::min(j0 + kParts, grid.rows);
    float& top = tiled.maximum[block];
    for (int j = j0; j < j1; ++j) {
        for (int i = i0; i < i1; ++i) {
            const float height = layer[grid.index(i, j)];
            if (isMissing(height))
                continue;
            const auto small = std::size_t(kEdge * ((j - j0) / kEdge) + (i - i0) / kEdge);
            float& part = tiled.maximum[tiled.parts(block) + small];
            tiled.maximum[tiled.indexOfCell(i, j)] = height;
            part = std::max(part, height);
            top = std::max(top, height);
        }
    }
}

}  // namespace

std::size_t TiledHeights::indexOfCell(int i, int j) const {
    const auto large =
        std::size_t(j / kParts) * std::size_t(blockColumns) + std::size_t(i / kParts);
    const auto small = std::size_t(kEdge * (j % kParts / kEdge) + i % kParts / kEdge);
    return parts(parts(large) + small) + std::size_t(kEdge * (j % kEdge) + i % kEdge);
}

TiledHeights tiledHeights(const GridSpec& grid, const std::vector<float>& layer) {
    assert(layer.size() == grid.cellCount());
    TiledHeights tiled;
    tiled.grid = grid;
    tiled.blockColumns = (grid.columns + kParts - 1) / kParts;
    tiled.blockRows = (grid.rows + kParts - 1) / kParts;
    const std::size_t blocks = tiled.blocks();
    tiled.maximum.assign(blocks * (1 + kParts + kParts * kParts), -kInfinity);
    parallelFor(0, blocks, 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t block = first; block < last; ++block)
            fillBlock(tiled, layer, block);
    });
    tiled.highest = -double(kInfinity);
    for (std::size_t block = 0; block < blocks; ++block)
        tiled.highest = std::max(tiled.highest, double(tiled.maximum[block]));
    for (const float height : layer) {
        if (std::isfinite(height))
            tiled.magnitude = std::max(tiled.magnitude, std::abs(double(height)));
    }
    return tiled;
}

}  // namespace reflet
