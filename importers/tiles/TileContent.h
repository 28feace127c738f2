// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/gltf/GltfCityMesh.h"

#include <glm/mat4x4.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::tiles {

/// What of a tile's content is shown in one go: a mesh, wherever it stands.
struct TilePart {
    gltf::CityMesh mesh;         ///< its images: each has the file that it is embedded in
    std::filesystem::path file;  ///< of the glTF: what it refers to lies beside it
    std::vector<glm::dmat4> tile_from_mesh;  ///< one, or one for each instance (i3dm)
    std::vector<std::string> batchNames;     ///< of the batch table: features by number
};

struct ContentLimits {
    std::size_t maxTriangles = 20'000'000;  ///< of a tile, instances counted
    std::size_t maxInstances = 1'000'000;
    int deepest = 8;  ///< composites in composites
};

/// Reads the content of a tile of 3D Tiles 1.0 or 1.1: glTF, b3dm, i3dm, cmpt; its first bytes
/// decide. `zUp`: the glTF in it has z up already (a legacy of version 0). `path` names it; what
/// it refers to is looked for in its folder. Unreadable where it is damaged or cut off, Refused for
/// point clouds and other content by its name, ResourceLimit.
[[nodiscard]] Result<std::vector<TilePart>> readTileContent(std::string_view bytes,
                                                            const std::filesystem::path& path,
                                                            bool zUp, const ContentLimits& limits,
                                                            const JobContext& job);

}  // namespace reflet::tiles
