// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"

#include <glm/mat4x4.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace reflet::tiles {

/// The content of a tile that is to be shown.
struct TileUse {
    std::filesystem::path file;
    std::string name;  ///< relative to the tileset's folder, with slashes
    glm::dmat4 world_from_tile{1.0};
    bool zUp = false;  ///< its glTF has z up already (asset.gltfUpAxis)
};

/// The tiles of a tileset, as fine as was asked.
struct TileTree {
    std::string version;
    std::vector<TileUse> tiles;
    /// Geometric errors that tiles with others below them have, each once, ascending.
    std::vector<double> errors;
    bool geocentric = false;  ///< its volumes are regions of the Earth
    std::size_t missing = 0;  ///< files that are named and are not there
    std::vector<Diagnostic> remarks;
};

struct TreeLimits {
    std::size_t maxTiles = 1'000'000;
    std::size_t maxTilesets = 100'000;  ///< external ones
    int deepest = 100;                  ///< tiles below tiles, tilesets included
    /// Tiles of this geometric error (metres) or less stand for those below them.
    double goodEnough = -1.0;
};

/// Walks a tileset (tileset.json of 3D Tiles 1.0 or 1.1) and those that it refers to. Where tiles
/// replace their parents the finest are taken that are there and asked for; where they add to them,
/// all of those. Tiles of
/// implicit tilings are those whose files are there. What is missing, lies outside the tileset's
/// folder or in the network, and tilesets that hold themselves, are left out with a remark.
/// Unreadable for what is no tileset, ResourceLimit, Cancelled.
[[nodiscard]] Result<TileTree> readTileTree(const std::filesystem::path& path,
                                            const TreeLimits& limits, const JobContext& job);

}  // namespace reflet::tiles
