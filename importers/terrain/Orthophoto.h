// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"
#include "core/city/CityModel.h"

#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// An orthophoto: a raster of colours with a place.
struct Orthophoto {
    std::filesystem::path file;
    std::string crs;         ///< of a file that declares none; "" or "local" = the frame's
    glm::dvec2 offset{0.0};  ///< metres that it is moved by, grid east and north
};

struct OrthophotoOptions {
    /// Textures for all pictures together; where they would need more, their pixels grow. This many
    /// fit into the graphics card's share with all their smaller copies.
    std::size_t mostTiles = 28;
};

/// Lays pictures on the ground of a city: on terrain, land use, roads and water that have neither
/// a texture nor a material of their own (a ground made by Reflet counts as without) and are less
/// steep than 60 degrees. Triangles are cut at the rims of the textures, which changes no height.
/// Where pictures overlap the first counts; beyond them the ground looks as it did. The textures
/// are parts of the files (CityTexture::window), read when something is drawn. Unreadable, Refused
/// for a picture that cannot be brought into the frame's system.
[[nodiscard]] Result<std::vector<Diagnostic>> drape(CityModel& city,
                                                    const std::vector<Orthophoto>& pictures,
                                                    const OrthophotoOptions& options,
                                                    const JobContext& job);

}  // namespace reflet
