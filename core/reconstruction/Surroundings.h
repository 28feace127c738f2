// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/HeightfieldTracer.h"

namespace reflet {

/// Metres from a position to the nearest thing around and above it that rays meet, at most `most`:
/// what decides how fast a reflection goes stale when a vehicle moves (Detail::reuse). By 96 rays
/// from five degrees below the horizon upwards; the ground under a vehicle counts for nothing.
[[nodiscard]] double nearestSurroundings(const HeightfieldTracer& tracer,
                                         const glm::dvec3& position, double most);

}  // namespace reflet
