// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/LodSettings.h"

namespace reflet {

/// How texture coordinates run between the vertices of a quad (DESIGN 5.3).
enum class Interpolation {
    Exact,      ///< q = d′ + (P − C)/z, exact on planes
    AsInPaper,  ///< the vectors C→I linearly, as the 2003 hardware did
};

/// Which REMs serve a point, and with what weights.
enum class Weighting {
    /// Ours: the two REMs that see the point best, among as many as remsPerVehicle. What counts is
    /// how alike their view of the point is to the vehicle's: the angle at the point, and how much
    /// farther they stand from it. The weights are continuous in the position of the vehicle.
    BySight,
    /// The same two REMs for the whole map, weighed by the projection of the point onto the line
    /// between them (Meyer & Loscos 2003, section 4.2).
    AsInPaper,
};

/// The most REMs that one map is made from.
inline constexpr int kMostRems = 8;

/// Settings of the multiple-environment-map reconstruction; defaults are the paper's but for what
/// is marked as ours.
struct MemSettings {
    /// N: quads along an edge of a face before subdivision; between 1 and the resolution.
    int meshSize = 10;
    /// R: a quad is split when the distances of two of its corners differ by more than R times the
    /// smaller. Infinity never splits (the plain mesh), 0 always does (the full mesh).
    double depthRatio = 0.2;
    /// Ours: above 0, it takes the place of R. A quad is split when the texels that it interpolates
    /// would be looked up this many texels of the map, as seen from P, beside where a ray through
    /// its middle says. Planes are never split, however slanted.
    double errorBound = 0.0;
    double smallestQuad = 1.0;  ///< texels; no child is smaller; 1 = one texel
    /// Ours: split also where validity or REM choice differs, or where surface meets sky.
    bool refineAtValidity = true;
    /// Ours: where one texel is the limit (smallestQuad <= 1) and a smallest quad still wants to be
    /// split, its texels get a ray each, through their centres. Without it a quad that lies across
    /// a silhouette mixes two surfaces.
    bool traceEdgeTexels = true;
    /// Ours: a hit of the heightfield that a REM sees is moved along its ray onto the plane that
    /// the REM's distances show there, by four cells at most: heightfields know oblique walls and
    /// roofs only as stairs. Off, all errors but those of the heightfield remain (DESIGN 5.8).
    bool refineHits = true;
    Interpolation interpolation = Interpolation::Exact;
    Weighting weighting = Weighting::BySight;
    int remsPerVehicle = kMostRems;  ///< for Weighting::BySight; between 1 and kMostRems
    int resolution = 128;            ///< of the local map
    /// Ours: a body looks its map up where its mirrored ray ends, by the map's own distances, not
    /// by direction alone as if all were infinitely far (core/environment/DistanceImpostor.h).
    bool parallax = true;
    LodSettings lod = {};  ///< of pictures of a movement; maps are not made from it

    friend bool operator==(const MemSettings&, const MemSettings&) = default;
};

}  // namespace reflet
