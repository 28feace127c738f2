// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/Vehicle.h"

namespace reflet {

/// Five bodies on three bogies, 33 m × 2.65 m × 3.5 m (without pantograph).
[[nodiscard]] Vehicle makeTram();
/// A rigid low-floor bus, 12 m × 2.55 m × 3.05 m, in two bodies that share their pivots (axles).
[[nodiscard]] Vehicle makeBus();
/// A compact car, 4.4 m × 1.82 m × 1.46 m.
[[nodiscard]] Vehicle makeCar();
/// A polished chrome ball of radius 1 m, its centre 1.2 m above the ground.
[[nodiscard]] Vehicle makeSphere();
/// People of 1.69 m, 1.8 m and 1.2 m, who walk.
[[nodiscard]] Vehicle makeWoman();
[[nodiscard]] Vehicle makeMan();
[[nodiscard]] Vehicle makeChild();
/// A chrome whale, 14 m, in three bodies that are rigidly coupled; its belly is about half a metre
/// above the height of its route.
[[nodiscard]] Vehicle makeWhale();
/// A chrome tree, 7.4 m high.
[[nodiscard]] Vehicle makeMirrorTree();

}  // namespace reflet
