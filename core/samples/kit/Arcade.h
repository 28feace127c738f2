// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Facade.h"
#include "core/samples/kit/Random.h"

namespace reflet::kit {

struct ArcadeStyle {
    double height = 6.2;     ///< of the ground floor's front
    double depth = 4.4;      ///< from the front to the shops
    double pier = 1.1;       ///< width of a pier
    double thickness = 0.8;  ///< of the front wall
    double springing = 3.35;
    Paint wall = Paint::Stone;
    Paint trim = Paint::StonePale;
};

/// A walk behind semicircular arches on piers, `bays` of them over the façade's length: both faces
/// of the front wall, soffits and jambs, archivolts with keystones, imposts, ribs, ceiling, shops
/// at the back, lanterns.
void arcade(Mesh& mesh, const Facade& f, int bays, const ArcadeStyle& style, Random& random);

}  // namespace reflet::kit
