// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/heightfield/HeightfieldTracer.h"

#include <algorithm>
#include <utility>

namespace reflet {

namespace {

MaxPyramid::Level pooled(const MaxPyramid::Level& fine) {
    MaxPyramid::Level coarse;
    coarse.columns = (fine.columns + 1) / 2;
    coarse.rows = (fine.rows + 1) / 2;
    coarse.maximum.resize(std::size_t(coarse.columns) * std::size_t(coarse.rows));
    parallelFor(0, std::size_t(coarse.rows), 32, [&](std::size_t first, std::size_t last) {
        for (std::size_t j = first; j < last; ++j) {
            // The last row and column of an odd level are pooled with themselves.
            const float* lower = fine.maximum.data() + 2 * j * std::size_t(fine.columns);
            const float* upper = int(2 * j + 1) < fine.rows ? lower + fine.columns : lower;
            float* out = coarse.maximum.data() + j * std::size_t(coarse.columns);
            for (int i = 0; i < coarse.columns; ++i) {
                const int left = 2 * i;
                const int right = std::min(left + 1, fine.columns - 1);
                out[i] = std::max(std::max(lower[left], lower[right]),
                                  std::max(upper[left], upper[right]));
            }
        }
    });
    return coarse;
}

}  // namespace

MaxPyramid buildMaxPyramid(const GridSpec& grid, const std::vector<float>& layer) {
    MaxPyramid pyramid;
    pyramid.grid = grid;
    MaxPyramid::Level base{grid.columns, grid.rows, layer};
    for (float& height : base.maximum) {
        if (isMissing(height)) {
            height = -kInfinity;
        }
    }
    pyramid.levels.push_back(std::move(base));
    while (pyramid.levels.back().columns > 1 || pyramid.levels.back().rows > 1) {
        pyramid.levels.push_back(pooled(pyramid.levels.back()));
    }
    return pyramid;
}

}  // namespace reflet
