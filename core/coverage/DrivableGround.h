// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"
#include "core/heightfield/Heightfield.h"

#include <cstddef>
#include <vector>

namespace reflet {

/// Where vehicles can drive.
struct DrivableGround {
    GridSpec grid;
    std::vector<unsigned char> cells;  ///< by GridSpec::index; 1 = drivable
    bool modelled = false;             ///< by the model's own roads and squares
    std::size_t count = 0;             ///< of drivable cells

    /// Places on the ground at the middles of drivable cells, on a lattice of at least `spacing`
    /// metres, project frame; row by row.
    [[nodiscard]] std::vector<glm::dvec3> places(const Heightfield& field, double spacing) const;
    [[nodiscard]] double squareMetres() const {
        return double(count) * grid.cellSize * grid.cellSize;
    }
};

/// The road and square surfaces of the model (objects Road and TransportSquare; where they tell
/// traffic areas from the rest, those alone) where nothing stands on them. Without any: ground at
/// least 1.5 m from what stands on it and from water and planted areas, under 15 % slope, in strips
/// at least 3 m wide, within 15 m of the built-up part and some 40 m of what stands higher than
/// 2.5 m, not in enclosed courtyards.
[[nodiscard]] DrivableGround drivableGround(const Heightfield& field, const CityModel& city);

}  // namespace reflet
