// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace reflet {

/// Lifts objects whose heights count from the ground onto the terrain: by its lowest height under
/// their vertices, those of all objects below one root together, so that parts stay together and no
/// base floats. Where there is no terrain under any of them, they stay. Terrain are the triangles
/// of terrain objects. `objects`: indices into the model's, which share no vertex with others.
/// Returns how many were lifted.
std::size_t drapeOnTerrain(CityModel& model, std::span<const std::uint32_t> objects);

}  // namespace reflet
