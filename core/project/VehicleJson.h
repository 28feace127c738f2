// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/VehicleModel.h"

#include <array>
#include <optional>
#include <string>
#include <utility>

namespace reflet {

/// Metres per unit of a vehicle's file that a project may ask for.
inline constexpr double kSmallestVehicleScale = 1e-6;
inline constexpr double kLargestVehicleScale = 1e6;

inline constexpr std::array<std::pair<VehicleUp, const char*>, 6> kVehicleUpTexts{
    {{VehicleUp::PlusY, "+y"},
     {VehicleUp::MinusY, "-y"},
     {VehicleUp::PlusZ, "+z"},
     {VehicleUp::MinusZ, "-z"},
     {VehicleUp::PlusX, "+x"},
     {VehicleUp::MinusX, "-x"}}};

/// As in project files and on the command line: "+y".
[[nodiscard]] inline std::string upText(VehicleUp up) {
    for (const auto& [value, text] : kVehicleUpTexts) {
        if (value == up)
            return text;
    }
    return "+y";
}

[[nodiscard]] inline std::optional<VehicleUp> upFromText(const std::string& text) {
    for (const auto& [value, name] : kVehicleUpTexts) {
        if (text == name)
            return value;
    }
    return std::nullopt;
}

}  // namespace reflet
