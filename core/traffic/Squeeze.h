// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/Vehicle.h"

namespace reflet {

/// How strongly a body's surface squeezes its surroundings together (DESIGN 5.4): texels of a cube
/// map with N texels along an edge that a pixel of the body covers, times pixels along the longest
/// edge of its bounds, divided by N. Seen from afar, from eight sides and a little above; the
/// median over what is seen of it and reflects.
///
/// A sphere squeezes the whole map, 6 N² texels, evenly into its outline of π/4 p² pixels:
/// sqrt(24/π), 2.76. Flat sides squeeze nothing: 0. A body without a reflecting surface: 0. Of
/// meshes with more than 2^15 triangles every n-th one counts.
[[nodiscard]] double squeezeOf(const Vehicle& vehicle, const VehicleBody& body);

}  // namespace reflet
