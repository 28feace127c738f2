// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/geo/Crs.h"
#include "core/io/RasterFile.h"
#include "importers/terrain/HeightGrid.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet::terrain {

/// Pixels of a mosaic: columns and rows from the first to before the last.
struct PixelWindow {
    int firstColumn = 0, firstRow = 0;
    int columns = 0, rows = 0;
};

/// One file of heights.
struct TerrainTile {
    std::string file;   ///< for messages
    std::string bytes;  ///< of a file in memory; else empty
    RasterInfo info;
    int column = 0, row = 0;  ///< of its first pixel in the mosaic

    [[nodiscard]] Result<RasterFile> open() const;
};

/// Tiles of one grid, read as if they were one file, so that no seam is left between them. Where
/// tiles overlap the first that has a height counts.
struct Mosaic {
    std::vector<TerrainTile> tiles;
    RasterInfo info;    ///< of the whole; columns and rows too
    double unit = 1.0;  ///< metres per unit of the heights
};

/// Files whose grids fit each other (same system, pixel size and phase) come together. The order of
/// the groups and of the tiles in them is that of the files.
[[nodiscard]] std::vector<Mosaic> groupTiles(std::vector<TerrainTile> tiles);

/// Metres per unit of heights by a CRS: of its vertical part, else of its horizontal one, as in the
/// surveys of US counties that are in feet throughout. The same rule as importers::Placement has.
[[nodiscard]] double heightUnitOf(const Crs& crs);

/// What was read of a mosaic.
struct MosaicHeights {
    HeightGrid grid;
    PixelWindow window;
    int step = 1;  ///< the grid holds every step-th post of the window
    /// Posts between lie no further than this from the finest triangles over the grid; NaN when
    /// they were too many to be looked at.
    double omittedError = 0.0;
    std::size_t missing = 0;     ///< posts of the grid without a height
    std::size_t outOfRange = 0;  ///< of those looked at: counted as missing
};

struct ReadLimits {
    std::size_t mostPosts = std::size_t(1) << 24;     ///< that a grid may hold
    std::size_t mostLookedAt = std::size_t(1) << 29;  ///< in windows that are larger
};

/// Reads a window row by row, in metres. Of a window of too many posts, every second, third ... is
/// taken. Unreadable for damaged data, Cancelled.
[[nodiscard]] Result<MosaicHeights> readWindow(const Mosaic& mosaic, const PixelWindow& window,
                                               const ReadLimits& limits, const JobContext& job);

/// Lowest and highest height, and how many there are, of a whole mosaic, in its own unit.
struct HeightStatistics {
    std::size_t valid = 0;
    double lowest = 0.0, highest = 0.0;
};
[[nodiscard]] Result<HeightStatistics> statisticsOf(const TerrainTile& tile, const JobContext& job);

}  // namespace reflet::terrain
