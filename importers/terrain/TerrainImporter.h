// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <limits>
#include <string_view>
#include <vector>

namespace reflet {

struct TerrainOptions {
    /// No post of the file lies further from the surface than this, metres; 0 keeps every post.
    double error = 0.05;
    /// Of one grid: where the error would need more, it grows, and the report says to what.
    std::size_t mostTriangles = 1'000'000;
    /// Posts held in memory; of larger grids only every second, third ... is taken.
    std::size_t mostPosts = std::size_t(1) << 24;
    std::size_t mostLookedAt = std::size_t(1) << 29;  ///< posts that are read for the error
};

/// A terrain of raster files: one TINRelief object for each grid, named after its first file. Files
/// whose grids fit each other make one grid, without a seam between them.
///
/// A post stands at the centre of each pixel. Pixels without a height (no-data value, mask, numbers
/// beyond 12 km) make no triangles. East and north come into the frame by PROJ, post by post, and
/// nothing is resampled; heights are turned into metres by the unit of the band, else of the CRS,
/// and keep their datum. `options.bbox` keeps the posts in it and those around them.
///
/// Unreadable for what is no raster or damaged, Refused as for city models and for pictures; the
/// summary is that of all files together.
[[nodiscard]] Result<Imported<CityImport>> importTerrain(
    const std::vector<std::filesystem::path>& files, const ImportOptions& options,
    const TerrainOptions& terrain, const JobContext& job);

/// The same of one file in memory, whose `name` ends as the file's would.
[[nodiscard]] Result<Imported<CityImport>> importTerrainBytes(std::string_view bytes,
                                                              const std::string& name,
                                                              const ImportOptions& options,
                                                              const TerrainOptions& terrain,
                                                              const JobContext& job);

/// What a raster file holds: its size, its bounds as the corners of its outermost pixels, of a
/// terrain the lowest and highest height.
[[nodiscard]] Result<Imported<SourceSummary>> inspectRaster(const std::filesystem::path& file,
                                                            const ImportOptions& options,
                                                            const JobContext& job);

/// A raster as a model of its own: a terrain, or nothing to show yet for a picture, whose summary
/// then has a texture.
[[nodiscard]] Result<Imported<CityImport>> importRaster(const std::filesystem::path& file,
                                                        const ImportOptions& options,
                                                        const JobContext& job);

enum class RasterUse { None, Terrain, Orthophoto };
/// What a file is good for, by its bands: colours make an orthophoto, a single band a terrain. None
/// for what is no raster.
[[nodiscard]] RasterUse rasterUse(const std::filesystem::path& path);

/// The files behind one that is named: of a folder the rasters in it, by name; of a list (a text
/// with one path a line, relative to it) those in it; else the file itself. Unreadable when there
/// are none.
[[nodiscard]] Result<std::vector<std::filesystem::path>> rasterFiles(
    const std::filesystem::path& path);

}  // namespace reflet
