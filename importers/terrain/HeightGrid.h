// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace reflet::terrain {

/// Heights at the posts of a regular grid, row by row as in the file. NaN = there is none.
struct HeightGrid {
    int columns = 0, rows = 0;
    std::vector<float> heights;  ///< metres

    [[nodiscard]] float at(int i, int j) const {
        return heights[std::size_t(j) * std::size_t(columns) + std::size_t(i)];
    }
    [[nodiscard]] bool contains(int i, int j) const { return i < columns && j < rows; }
};

}  // namespace reflet::terrain
