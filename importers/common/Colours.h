// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

namespace reflet::importers {

/// The colours of city formats are X3D's, that is display values in sRGB (IEC 61966-2-1), 0..1 and
/// clamped to it: made linear here.
[[nodiscard]] glm::vec3 linearFromSrgb(const glm::dvec3& srgb);

}  // namespace reflet::importers
