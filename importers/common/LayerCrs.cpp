// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/LayerCrs.h"

#include "core/geo/Crs.h"

namespace reflet::importers {

bool canBeDegrees(const Box& box) {
    constexpr double kMost = 180.0;
    return box.empty() ||
           (box.min.x >= -kMost && box.max.x <= kMost && box.min.y >= -kMost && box.max.y <= kMost);
}

std::optional<std::string> layerCrs(const VectorLayer& layer, const Box& box,
                                    const ImportOptions& options) {
    if (!layer.crs)
        return std::nullopt;
    if (layer.assumedCrs && (!canBeDegrees(box) || !options.crs.empty()))
        return std::nullopt;
    const auto crs = Crs::parse(*layer.crs);
    return crs ? crs->horizontal() : *layer.crs;
}

}  // namespace reflet::importers
