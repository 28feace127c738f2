// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/GltfModel.h"
#include "core/traffic/VehicleFitting.h"
#include "core/traffic/VehicleModel.h"

#include <string>
#include <vector>

namespace reflet {

enum class VehicleKind { Car, Bus, Tram };

/// "car", "bus" or "tram".
[[nodiscard]] const char* toString(VehicleKind kind);

/// A material and what it would be given, for people to read.
struct PaintProposal {
    std::string material;
    PaintGuess guess;
};

/// How a vehicle that comes in could be set on the road. Every choice has its reason as a sentence,
/// and can be changed in `model`, from which makeVehicle() makes the vehicle.
struct VehicleProposal {
    VehicleModel model;  ///< path and hash are left to the caller
    VehicleKind kind = VehicleKind::Car;
    double length = 0.0, width = 0.0, height = 0.0;  ///< metres, as proposed
    std::string front;                               ///< axis of the file that drives ahead: "+z"
    bool frontCertain = false;                       ///< told by names, not guessed
    std::string upReason, sizeReason, frontReason, groundReason, paintReason;
    std::vector<PaintProposal> paint;   ///< largest first; colours of one texture told apart
    double reflectingBefore = 0.0;      ///< share of the area that would reflect as in the file
    double reflectingAfter = 0.0;       ///< and as proposed
    std::vector<std::string> concerns;  ///< what a person should look at
};

[[nodiscard]] VehicleProposal proposeFit(const GltfModel& model);

}  // namespace reflet
