// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"

#include <QImage>
#include <memory>
#include <stop_token>
#include <vector>

namespace reflet {

/// A picture of a city from above and ever smaller copies of it: level 0 has a pixel for each cell
/// (or each few of them in a huge grid), each next one half as many along an edge. Rows from the
/// north. Light comes from the north-west, as maps are shaded; buildings and trees (whatever stands
/// out of the ground) are warm, the ground is cool; what is unknown is transparent.
struct PlanPicture {
    double west = 0.0;  ///< project frame, metres
    double north = 0.0;
    double metresAPixel = 1.0;  ///< of level 0
    std::vector<QImage> levels;

    [[nodiscard]] double width() const { return metresAPixel * levels.front().width(); }
    [[nodiscard]] double height() const { return metresAPixel * levels.front().height(); }
};

/// Any thread. Null when stopped, or when the grid has no cells.
[[nodiscard]] std::shared_ptr<const PlanPicture> paintPlan(const Heightfield& heightfield,
                                                           const std::stop_token& stop);

}  // namespace reflet
