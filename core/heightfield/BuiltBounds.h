// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"
#include "core/math/Geometry.h"

namespace reflet {

/// The box around what stands on the ground, from the ground up, project frame; where nothing does,
/// around all of it. Ground that reaches far beyond the last house is left out. Empty for an empty
/// field.
[[nodiscard]] Box builtBounds(const Heightfield& field);

/// The same for the part of it, a square of about `edge` metres, in which most stands: where to
/// begin in a city that is scattered over kilometres.
[[nodiscard]] Box busiestBounds(const Heightfield& field, double edge);

}  // namespace reflet
