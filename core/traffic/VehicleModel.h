// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>

#include <string>

namespace reflet {

/// The axis of a vehicle's file that points up. glTF says +Y; not every file obeys.
enum class VehicleUp { PlusY, MinusY, PlusZ, MinusZ, PlusX, MinusX };

/// A vehicle that the user brought as a glTF file, and how it is set on the road. A file that obeys
/// glTF (metres, +Y up, +Z forward) needs nothing but its path.
///
/// The file is turned upright by `up`, scaled, turned by `heading` about the vertical and moved by
/// `offset`; the result is in the vehicle's frame: x forward, y left, z up, z = 0 on the running
/// surface, the vehicle's middle at x = y = 0.
struct VehicleModel {
    std::string id;
    std::string path;  ///< relative to the project file where that is possible, '/' separated
    std::string hash;  ///< ContentHash of the file's bytes when it was imported; may be empty
    VehicleUp up = VehicleUp::PlusY;
    double scale = 1.0;      ///< metres per unit of the file
    double heading = 0.0;    ///< radians counter-clockwise seen from above; degrees in the file
    glm::dvec3 offset{0.0};  ///< metres
    /// Clear coat on paint and reflecting glass in windows where the file has none.
    bool coat = true;

    friend bool operator==(const VehicleModel&, const VehicleModel&) = default;
};

}  // namespace reflet
