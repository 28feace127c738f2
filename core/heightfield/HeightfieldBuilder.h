// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/city/CityModel.h"
#include "core/heightfield/HeightRules.h"
#include "core/heightfield/Heightfield.h"

namespace reflet {

struct HeightfieldSettings {
    double cellSize = 0.0;  ///< metres; 0 = automatic: the finest of 0.5, 0.625, 1, 1.25, 2 ... m
                            ///< with at most `maxCells`, beyond 2 m for a huge city: never fails
    std::size_t maxCells = 4'000'000;    ///< of an automatic choice
    std::size_t cellLimit = 64'000'000;  ///< refuse (ResourceLimit) a given cell size beyond this
    HeightRules rules;                   ///< what counts to which layer

    friend bool operator==(const HeightfieldSettings&, const HeightfieldSettings&) = default;
};

/// The grid over the model's bounds. Cell origins are multiples of the cell size in the CRS (not
/// in the project frame), so that tiles of one city agree where they overlap.
/// ResourceLimit, with a size that fits, when a given cell size needs more than the limit of cells;
/// Usage for a negative or infinite one; Refused for a city without geometry.
[[nodiscard]] Result<GridSpec> gridFor(const CityModel& city, const HeightfieldSettings& settings);

/// Clips each triangle to each cell that its closure touches and keeps the exact maximum of the
/// pieces: conservative, and bit-identical for any order and any number of threads; tiles of one
/// city in one frame are bit-identical where they overlap. What the layers hold: Heightfield.
///
/// Which objects raise what is the rules' affair (HeightPolicy); whichever way a surface faces, it
/// raises the top. Closure surfaces raise nothing, and the GroundSurfaces of what stands on the
/// ground no layer but `spans`. Holes of the terrain are filled from the Delaunay triangulation of
/// all terrain vertices (at steps the lower one), so the ground reaches to their convex hull and is
/// missing beyond. Where the terrain covers the cells, an added object never lowers a layer; where
/// only interpolated ground was shown, a surface replaces it. Triangles with coordinates that are
/// not finite are left out.
///
/// Usage for a grid without cells, ResourceLimit when memory ends, Cancelled with the job.
/// DESIGN 5.1. Memory: 16 bytes a cell, and some 400 a terrain vertex while holes are filled (none
/// where the terrain covers its cells); 12 a span of the columns that are hollow somewhere.
[[nodiscard]] Result<Heightfield> buildHeightfield(const CityModel& city, const GridSpec& grid,
                                                   const HeightRules& rules, const JobContext& job);
/// By the rules as they are without a choice.
[[nodiscard]] Result<Heightfield> buildHeightfield(const CityModel& city, const GridSpec& grid,
                                                   const JobContext& job);

}  // namespace reflet
