// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/EnvironmentMap.h"

#include <cstddef>
#include <optional>
#include <span>

namespace reflet {

/// The index of the box nearest to the map's centre that the map shows: the ray through the centre
/// of one of its texels enters the box no later than it ends, by the texel's distance. Ties by
/// index; nullopt when it shows none. What is smaller than a texel may be missed: widen the boxes.
/// @param boxes  of the project frame; none of them empty
[[nodiscard]] std::optional<std::size_t> nearestBoxSeen(const ReferenceEnvironmentMap& map,
                                                        std::span<const Box> boxes);

}  // namespace reflet
