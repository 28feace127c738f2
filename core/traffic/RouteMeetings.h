// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to core/traffic.
#pragma once

#include "core/traffic/Route.h"

#include <vector>

namespace reflet {

/// A stretch of a route, metres from its start.
struct Stretch {
    double from = 0.0;
    double to = 0.0;
};

/// Where two routes come so near that who drives there is in the other's way.
struct Meeting {
    Stretch first, second;
    bool along = false;  ///< both go the same way there: one may follow the other
};

/// Points every metre.
[[nodiscard]] std::vector<glm::dvec3> sampled(const Route& route);

/// All places where the routes come nearer than `distance` in the plan and `height` in height, in
/// the order of the first route. Lengths are whole metres (of sampled()).
[[nodiscard]] std::vector<Meeting> meetings(const std::vector<glm::dvec3>& first,
                                            const std::vector<glm::dvec3>& second, double distance,
                                            double height);

}  // namespace reflet
