// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/PartMesh.h"

namespace reflet {

/// Removes vertices that a flat or evenly curved surface does not need, until the surface or the
/// border of a material would move by about `error` metres. Vertices that stay keep their places
/// and normals. Borders between materials and creases stay closed: no cracks.
void thin(PartMesh& mesh, float error);

/// Metres that a vehicle's surface may move: less than a pixel at two metres.
inline constexpr float kThinning = 0.001F;

}  // namespace reflet
