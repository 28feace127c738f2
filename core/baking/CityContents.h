// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/CellGrid.h"
#include "core/baking/RadianceScene.h"
#include "core/baking/SurfaceLook.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace reflet {

/// What a city shows in each cell of a grid, as numbers to be compared: equal where nothing that
/// rays could find differs, and different (but for chance of 2⁻⁶⁴) where something does.
struct CellContents {
    CellGrid grid;
    std::vector<std::uint64_t> cells;  ///< by CellGrid::index; 0 = empty
    std::uint64_t everywhere = 0;      ///< of triangles too large, or unsound, to be in a cell
};

/// What rays can find of a city, triangle by triangle: its corners, and all that its look is made
/// of, also where that depends on the rest of its building. The order of objects, surfaces and
/// triangles says nothing.
class CityContents {
public:
    /// looks: of the city, which must outlive this. textures: the numbers that stand for them, by
    /// contentOf(); 0 for an image that is missing.
    CityContents(const CityModel& city, const SurfaceLooks& looks,
                 std::span<const std::uint64_t> textures);
    [[nodiscard]] CellContents in(const CellGrid& grid) const;

private:
    [[nodiscard]] std::uint64_t ofSurface(std::uint32_t surface) const;
    [[nodiscard]] std::uint64_t ofTriangle(std::size_t triangle) const;

    const CityModel& m_city;
    const SurfaceLooks& m_looks;
    std::vector<std::uint64_t> m_textures;
    std::vector<std::uint64_t> m_surfaces;
};

/// A number that stands for an image as it is drawn; 0 for an empty one.
[[nodiscard]] std::uint64_t contentOf(const TextureImage& image, bool repeat);
/// The same for all textures of a city; images: one for each.
[[nodiscard]] std::vector<std::uint64_t> contentOf(std::span<const TextureImage> images,
                                                   const CityModel& city);

}  // namespace reflet
