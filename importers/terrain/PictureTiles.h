// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <string>
#include <vector>

namespace reflet::terrain {

/// A rectangle of the frame cut into textures. A texture shows its tile and a rim of some pixels
/// around it, so that filtering finds no edge between neighbours.
struct PictureGrid {
    glm::dvec2 min{0.0};  ///< south-west corner in the frame
    double pixel = 1.0;   ///< metres
    int columns = 1, rows = 1;

    /// Size of a tile without its rim, in pixels: with it and all their smaller copies, four fit on
    /// a texture page of 2048 by 2048.
    static constexpr int kWidth = 672, kHeight = 1014, kRim = 4;

    [[nodiscard]] glm::dvec2 tileSize() const { return pixel * glm::dvec2(kWidth, kHeight); }
};

/// Tiles over a rectangle with pixels of at least `pixel` metres, so large that there are at most
/// `mostTiles` of them.
[[nodiscard]] PictureGrid tileGrid(const glm::dvec2& min, const glm::dvec2& max, double pixel,
                                   std::size_t mostTiles);

/// The file behind the tiles.
struct PictureSource {
    std::string file;
    std::optional<std::string> crs;  ///< that its pixels are brought into; nullopt = its own
    glm::dvec2 shift{0.0};           ///< from that system into the frame
};

/// Gives triangles the textures of the grid, cut where a tile ends. What lies beyond stays as it
/// is. Corners on shared edges stay shared: no cracks.
void layOn(CityModel& city, const std::vector<std::uint32_t>& triangles, const PictureGrid& grid,
           const PictureSource& source);

}  // namespace reflet::terrain
