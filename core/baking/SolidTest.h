// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RayScene.h"

namespace reflet {

/// Whether a point lies inside a building, bridge or other construction. The sense of faces is not
/// asked, because files get it wrong: something of the object must lie straight above, and most of
/// a fixed set of directions must leave the object, or the root object with all its parts, an odd
/// number of times. A place under the open sky is never inside.
[[nodiscard]] bool insideSolid(const CityModel& city, const RayScene& scene,
                               const glm::vec3& point);

}  // namespace reflet
