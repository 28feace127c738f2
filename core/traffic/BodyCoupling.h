// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/Vehicle.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>

namespace reflet {

/// Whether bodies `first` and `first` + 1 of a vehicle, placed by these poses, move as one: they
/// follow the route with the same two pivots, and stand as far apart as in the straight vehicle.
/// Their local maps are cross-faded; those of bodies that meet in a joint are not.
[[nodiscard]] inline bool rigidlyCoupled(const Vehicle& vehicle, std::size_t first,
                                         const RigidTransform& project_from_first,
                                         const RigidTransform& project_from_second) {
    const VehicleBody& a = vehicle.bodies[first];
    const VehicleBody& b = vehicle.bodies[first + 1];
    const double shift = a.offset - b.offset;
    const bool samePivots = std::abs(a.pivotSpan - b.pivotSpan) < 1e-6 &&
                            std::abs(shift + a.pivotMiddle - b.pivotMiddle) < 1e-6;
    const double apart =
        glm::distance(project_from_first.translation, project_from_second.translation);
    return samePivots && std::abs(apart - std::abs(shift)) <= 1e-3;
}

}  // namespace reflet
