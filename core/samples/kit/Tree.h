// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Mesh.h"
#include "core/samples/kit/Random.h"

namespace reflet::kit {

/// Trees as templates, their foot at the origin, in metres of life size.
[[nodiscard]] Mesh planeTree(Random& random);    ///< about 11 m, mottled bark
[[nodiscard]] Mesh lindenTree(Random& random);   ///< about 8 m, oval crown
[[nodiscard]] Mesh stonePine(Random& random);    ///< about 12 m, an umbrella
[[nodiscard]] Mesh datePalm(Random& random);     ///< about 10 m
[[nodiscard]] Mesh cypress(Random& random);      ///< about 10 m, a spindle
[[nodiscard]] Mesh orangeTree(Random& random);   ///< about 3.6 m, with fruit
[[nodiscard]] Mesh oliveTree(Random& random);    ///< about 5 m
[[nodiscard]] Mesh distantTree(Random& random);  ///< a few leaves, for hillsides
/// Two metres of clipped hedge along x, 0.7 m wide, 1 m high.
[[nodiscard]] Mesh hedge(Random& random);
/// A round bed of flowers, 1.2 m radius.
[[nodiscard]] Mesh flowerBed(Paint blossom, Random& random);

/// A tree of exactly this many triangles, as the scene of Meyer and Loscos 2003 has them.
[[nodiscard]] Mesh treeOfTriangles(std::size_t triangles, double height, Random& random);

}  // namespace reflet::kit
