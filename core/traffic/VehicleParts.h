// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/PartMesh.h"
#include "core/traffic/Vehicle.h"

#include <glm/vec2.hpp>

namespace reflet {

// Parts that several vehicles share.

struct WheelSpec {
    float radius = 0.33F;
    float width = 0.22F;
    float rimRadius = 0.23F;
    int spokes = 5;
    int segments = 26;                         ///< around the disc; the tyre has twice as many
    std::uint16_t tyre = 0, rim = 0, hub = 0;  ///< materials; hub: what lies behind the spokes
};
/// A road wheel with spokes, its axis along y through (x, z = radius), its outer face at y = outer
/// on the left side (outer > 0) or the right (outer < 0). Touches z = 0.
[[nodiscard]] PartMesh roadWheel(const WheelSpec& spec, float x, float outer);

/// A plain dished wheel (tram, bus): tyre or steel rim and a disc with a hub.
[[nodiscard]] PartMesh discWheel(const WheelSpec& spec, float x, float outer);

/// Two seats side by side facing forward (or backward), their front edge at x, standing on `floor`.
[[nodiscard]] PartMesh seatPair(float x, float y, float floor, bool backward, std::uint16_t fabric,
                                std::uint16_t frame);

/// An upright pole from floor to ceiling.
[[nodiscard]] PartMesh pole(float x, float y, float from, float to, std::uint16_t material);

/// The finished part as a body: map centre in the middle of the height between z = low and z =
/// high.
[[nodiscard]] VehicleBody toBody(PartMesh mesh, float low, float high);

}  // namespace reflet
