// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace reflet {

/// A polygon in space: an outer ring and any number of holes, rings not closed (a repeated closing
/// point is dropped). Roles of the rings are a hint only: inside is decided by even-odd parity.
using PolygonRing = std::vector<glm::dvec3>;

struct TriangulatedPolygon {
    /// The input points ring after ring, followed by the points born where edges cross.
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< oriented like the outer ring
    double area = 0.0;            ///< square metres, sum of the triangles' (in space)
    double planeDeviation = 0.0;  ///< metres, greatest distance of a point from the fitted plane
    bool repaired = false;        ///< crossings, repeated points or odd rings had to be mended
    std::string problem;          ///< why there are no triangles; empty otherwise

    /// For input point i of the concatenated rings: points[i]. Crossing points have no input index.
    std::size_t inputPoints = 0;
};

/// Triangulates in the polygon's dominant plane: a triangle and a convex ring of up to eight
/// corners as a fan, a convex ring of up to 32 points, some of which may lie between two corners,
/// by Delaunay triangulation, all else by constrained Delaunay triangulation with even-odd parity
/// of the constraints that run along an edge (CGAL; exact predicates, and exact constructions where
/// edges cross). Invariant: the triangles' projected area is the rings' even-odd area. Points of
/// the input come back bit by bit and in their order. Never throws: what cannot be triangulated
/// (fewer than three points, collinear, not finite, rings that cancel out, more crossings than
/// twice the points plus a thousand) comes back without triangles and with `problem` set. Safe in
/// many threads at once.
[[nodiscard]] TriangulatedPolygon triangulatePolygon(std::span<const PolygonRing> rings);
/// The same into a value whose memory is used again: for one polygon after the other.
void triangulatePolygon(std::span<const PolygonRing> rings, TriangulatedPolygon& into);

}  // namespace reflet
