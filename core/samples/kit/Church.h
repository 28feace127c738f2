// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Facade.h"
#include "core/samples/kit/Random.h"

namespace reflet::kit {

/// A baroque church front of two orders over the façade's length (about 22 m), with pilasters,
/// portal, round window, volutes and pediment, and a nave behind it of the given depth.
void church(Mesh& mesh, const Facade& f, double naveDepth, Random& random);
/// A campanile with clock faces, an open belfry and a tiled dome, on a square plot; about 44 m.
void clockTower(Mesh& mesh, const Plot& plot, double z, Random& random);

}  // namespace reflet::kit
