// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/io/VectorFile.h"
#include "core/math/Geometry.h"
#include "importers/ImportTypes.h"

#include <optional>
#include <string>

namespace reflet::importers {

/// Whether coordinates in a box (nothing at all counts) can be degrees.
[[nodiscard]] bool canBeDegrees(const Box& box);

/// The CRS that a layer declares, in a form that Crs::parse() reads. GeoJSON is in degrees by RFC
/// 7946 where it says nothing; planners also ship metres: then it declares nothing. What the user
/// says counts before what the standard says. `box`: around the layer's coordinates.
[[nodiscard]] std::optional<std::string> layerCrs(const VectorLayer& layer, const Box& box,
                                                  const ImportOptions& options);

}  // namespace reflet::importers
