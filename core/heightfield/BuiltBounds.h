// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"
#include "core/math/Geometry.h"

namespace reflet {

/// The box around what stands on the ground, from the ground up, project frame; where nothing does,
/// around all of it. Ground that reaches far beyond the last house is left out. Empty for an empty
/// field.
[[nodiscard]] Box builtBounds(const Heightfield& field);

}  // namespace reflet
