// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/rendering/ViewRenderer.h"
#include "widgets/viewport/camera/Ground.h"

#include <glm/vec2.hpp>

namespace reflet {

/// Height of a walker's eyes over the ground, metres.
inline constexpr double kEyeHeight = 1.6;

/// What a walker is asked to do.
struct WalkInput {
    double ahead = 0.0;     ///< -1..1
    double sideways = 0.0;  ///< -1..1, right is positive
    double turn = 0.0;      ///< -1..1, left is positive
    bool fast = false;

    [[nodiscard]] bool idle() const { return ahead == 0.0 && sideways == 0.0 && turn == 0.0; }
};

/// Goes through a city on foot: follows the terrain, does not enter what stands on it and slides
/// along it, climbs no slope steeper than 45 degrees and does not leave the city.
class Walker {
public:
    /// Puts the camera on the nearest free place, looking the same way.
    [[nodiscard]] static Camera standing(const Ground& ground, const Camera& camera);
    /// The camera after `seconds` (a tenth at most is walked in one go, the rest is dropped).
    [[nodiscard]] static Camera walked(const Ground& ground, const Camera& camera,
                                       const WalkInput& input, double seconds);
    /// Whether a person has room here.
    [[nodiscard]] static bool isFree(const Ground& ground, const glm::dvec2& place);
};

}  // namespace reflet
