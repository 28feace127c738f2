// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace reflet {

/// Space in cubes of one size. The outermost reach on without end, so that each place lies in one.
struct CellGrid {
    glm::dvec3 origin{0.0};  ///< project frame; the lower corner of the first cell
    double size = 1.0;       ///< metres
    glm::ivec3 count{1};     ///< cells along x, y, z

    friend bool operator==(const CellGrid&, const CellGrid&) = default;

    [[nodiscard]] std::size_t cells() const {
        return std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z);
    }
    [[nodiscard]] std::size_t index(const glm::ivec3& cell) const {
        return (std::size_t(cell.z) * std::size_t(count.y) + std::size_t(cell.y)) *
                   std::size_t(count.x) +
               std::size_t(cell.x);
    }
    [[nodiscard]] glm::ivec3 clamped(const glm::ivec3& cell) const {
        return glm::clamp(cell, glm::ivec3(0), count - 1);
    }
    /// The cell of a place; of the nearest place in the grid for those beyond.
    [[nodiscard]] glm::ivec3 cellAt(const glm::dvec3& place) const {
        const glm::dvec3 at = (place - origin) / size;
        return glm::ivec3(glm::clamp(glm::floor(at), glm::dvec3(0.0), glm::dvec3(count - 1)));
    }
};

/// Cells over a city: as small as kFinestCell, larger where there would be more than kMostCells.
/// There is one more below and above than its box needs, and beside it so many that its soft light
/// comes from none of the outermost.
[[nodiscard]] CellGrid cellsOver(const Box& box);
inline constexpr double kFinestCell = 4.0;  ///< metres
inline constexpr std::size_t kMostCells = std::size_t(1) << 20U;

}  // namespace reflet
