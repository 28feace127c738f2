// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Mesh.h"
#include "core/samples/kit/Random.h"

#include <span>

namespace reflet::kit {

/// Leaves of a crown: flat kites of two triangles.
struct LeafStyle {
    double size = 0.5;              ///< metres along a leaf cluster
    double droop = 0.2;             ///< 0 = any way, 1 = hanging
    std::span<const Paint> paints;  ///< from shaded to sunlit
};

/// A kite-shaped leaf cluster at a point, roughly facing along `facing`.
void leaf(Mesh& mesh, const glm::dvec3& at, const glm::dvec3& facing, const LeafStyle& style,
          double light, Random& random);
/// A clump: `count` leaves on and in an ellipsoid; those further up and out are lighter.
void clump(Mesh& mesh, const glm::dvec3& center, const glm::dvec3& radii, int count,
           const LeafStyle& style, Random& random);
/// A crown made of clumps spread over an ellipsoid, denser at its surface.
void crown(Mesh& mesh, const glm::dvec3& center, const glm::dvec3& radii, int clumps,
           int leavesEach, double clumpRadius, const LeafStyle& style, Random& random);
/// A random unit vector.
[[nodiscard]] glm::dvec3 onSphere(Random& random);

}  // namespace reflet::kit
