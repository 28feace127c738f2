// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/tiles/TileTree.h"

#include <cstddef>
#include <optional>

namespace reflet::tiles {

/// Triangles that a city of tiles has at most where nobody says how fine it shall be.
inline constexpr std::size_t kMostTileTriangles = 4'000'000;

/// The tiles of a tileset whose geometric error is at most `geometricError` metres where there are
/// such; nullopt: the finest that together have at most `mostTriangles`, by their own counts, which
/// is told among the remarks where it is not the finest of all. Errors as readTileTree().
[[nodiscard]] Result<TileTree> chooseTiles(const std::filesystem::path& path,
                                           std::optional<double> geometricError,
                                           const JobContext& job,
                                           std::size_t mostTriangles = kMostTileTriangles);

/// The triangles of a tile's content by its own counts, for which no more of it is read than its
/// description; instances counted. 0 for what cannot be read.
[[nodiscard]] std::size_t countTileTriangles(const std::filesystem::path& file);

}  // namespace reflet::tiles
