// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/city/CityModel.h"
#include "core/heightfield/Heightfield.h"

namespace reflet {

struct HeightfieldSettings {
    double cellSize = 0.0;             ///< metres; 0 = automatic: 0.5..2 m with at most `maxCells`
    std::size_t maxCells = 4'000'000;  ///< of an automatic choice
    std::size_t cellLimit = 64'000'000;  ///< refuse (ResourceLimit) beyond this

    friend bool operator==(const HeightfieldSettings&, const HeightfieldSettings&) = default;
};

/// The grid over the model's bounds. Cell origins are multiples of the cell size in the CRS (not
/// in the project frame), so that tiles of one city agree where they overlap.
/// ResourceLimit when the bounds need more than the limit of cells.
[[nodiscard]] Result<GridSpec> gridFor(const CityModel& city, const HeightfieldSettings& settings);

/// Clips each triangle to each cell that its closure touches and keeps the exact maximum of the
/// pieces: conservative, and bit-identical for any order and any number of threads. Closure
/// surfaces and GroundSurface stay out of the top; the terrain layer comes from the TIN of the
/// terrain objects. Under a building the terrain is interpolated from the TIN around it.
/// DESIGN 5.1; reference: conservative clipping, not ray sampling.
[[nodiscard]] Result<Heightfield> buildHeightfield(const CityModel& city, const GridSpec& grid,
                                                   const JobContext& job);

}  // namespace reflet
