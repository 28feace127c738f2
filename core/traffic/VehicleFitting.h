// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/GltfModel.h"
#include "core/traffic/Vehicle.h"
#include "core/traffic/VehicleModel.h"

#include <glm/mat3x3.hpp>

#include <string>
#include <vector>

namespace reflet {

/// What a material of a file is taken for.
enum class PaintRole {
    AsInFile,  ///< shown as the file says
    Paint,     ///< gets clear coat
    Glass,     ///< gets reflecting glass
    Dull,      ///< tyres, seats, underbody: never reflects
};

struct PaintGuess {
    PaintRole role = PaintRole::AsInFile;
    std::string reason;    ///< readable: "its name says glass"
    double share = 0.0;    ///< of the model's area
    bool mirrors = false;  ///< reflects already, without clear coat or glass from us
};

/// One guess per material of the model, from names, transparency, area and darkness.
[[nodiscard]] std::vector<PaintGuess> guessPaint(const GltfModel& model);

/// Turns the file's axes so that x is forward, y left and z up, before the heading.
[[nodiscard]] glm::dmat3 uprightFromFile(VehicleUp up);

/// The model as a vehicle: upright, scaled, turned, moved, split into bodies of at most about 8 m.
/// A model that is longer than 8 m stays rigid: its bodies share their pivots. The result depends
/// on the arguments alone.
[[nodiscard]] Vehicle makeVehicle(const GltfModel& model, const VehicleModel& fit);

}  // namespace reflet
