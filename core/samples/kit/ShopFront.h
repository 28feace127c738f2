// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Facade.h"
#include "core/samples/kit/Random.h"

namespace reflet::kit {

/// A shop in the bay from u0 to u1, from the foot to `height`: stall riser, panes, door, sign board
/// with lettering. The bay must be open in the wall; everything stands at w in [-0.3, 0.1].
void shopFront(Mesh& mesh, const Facade& f, double u0, double u1, double height, Random& random);
/// A striped awning over the bay, its upper edge at v.
void awning(Mesh& mesh, const Facade& f, double u0, double u1, double v, double out, Paint paint);

}  // namespace reflet::kit
