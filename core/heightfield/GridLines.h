// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"
#include "core/heightfield/Heightfield.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace reflet {

/// How far an axis of the frame, whose zero lies at `origin` in the CRS, is from a multiple of the
/// cell size: origin = n·cellSize + phase with |phase| <= cellSize/2, rounded to a micrometre. The
/// rounding hides that 0.1 and its like are no binary fractions: at a northing of 5 800 000 m the
/// product n·0.1 is off by 3e-10 m.
[[nodiscard]] double gridPhase(double origin, double cellSize);

/// Borders and centres of the cells along one axis, such that two grids of one city give the same
/// doubles for the same line, whatever their own origins are.
struct GridLines {
    std::vector<double> border;  ///< count + 1, ascending
    std::vector<double> center;  ///< count
    double first = 0.0;          ///< border[0]
    double perCell = 1.0;        ///< 1 / cell size

    /// The cell of `u` up to rounding, clamped to [-1, count].
    [[nodiscard]] int nearCell(double u) const {
        return int(std::clamp(std::floor((u - first) * perCell), -1.0, double(count())));
    }
    [[nodiscard]] int count() const { return int(center.size()); }
};

[[nodiscard]] GridLines gridColumns(const GridSpec& grid, const ProjectFrame& frame);
[[nodiscard]] GridLines gridRows(const GridSpec& grid, const ProjectFrame& frame);

}  // namespace reflet
