// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/city/CityModel.h"

#include <cstddef>

namespace reflet {

/// A generated city: rolling terrain as a regular TIN, and on each block of 20 m a house with a
/// pitched roof, turned out of the grid. As many triangles as fit below `triangles`, at least one
/// block. Frame: local, from 0 to the square's edge.
[[nodiscard]] CityModel blockCity(std::size_t triangles);

struct HeightfieldBenchReport {
    std::size_t triangles = 0;
    std::size_t cells = 0;
    double ours = 0.0;       ///< seconds: the exact maximum of each cell, and the other layers
    double reference = 0.0;  ///< seconds: Embree's BVH and one ray down each cell's centre
    double tooLow = 0.0;     ///< share of the cells of which the ray misses more than a metre
};

/// Builds the heightfield of a generated city, beside what rays would read of it.
[[nodiscard]] Result<HeightfieldBenchReport> benchHeightfield(std::size_t triangles,
                                                              double cellSize,
                                                              const JobContext& job);

}  // namespace reflet
