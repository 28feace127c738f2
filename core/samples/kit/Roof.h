// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Facade.h"
#include "core/samples/kit/Random.h"

namespace reflet::kit {

/// A tiled roof with its ridge along the plot's longer side (or along x / y when told).
struct RoofStyle {
    double pitch = 0.45;     ///< rise over run
    double overhang = 0.45;  ///< over the eaves
    bool hipStart = true;    ///< at the low end of the ridge's axis; else a gable
    bool hipEnd = true;
    bool alongX = true;  ///< direction of the ridge
    Paint gable = Paint::PlasterCream;
    double course = 0.55;  ///< height of a band of tiles on the slope
    double patch = 3.0;    ///< length of a patch of one tone in it
    bool ridgeTiles = true;
};

/// Slopes in courses of tiles of several tones, fascia, soffit, gables, ridge tiles.
void tiledRoof(Mesh& mesh, const Plot& plot, double z, const RoofStyle& style, Random& random);
/// Height of the roof's slope above z at a point of the plot.
[[nodiscard]] double roofHeightAt(const Plot& plot, const RoofStyle& style, double x, double y);
/// A chimney with pots that starts at z0.
void chimney(Mesh& mesh, const glm::dvec2& center, double z0, double z1, Paint wall);
/// A gabled dormer whose front stands in the façade's plane moved inwards by `back`, its window's
/// foot at height v.
void dormer(Mesh& mesh, const Facade& f, double center, double back, double v, double pitch,
            Paint wall, Random& random);
/// A plane quadrilateral (eave a0 a1, ridge b0 b1) covered with tiles.
void tiledSlope(Mesh& mesh, const glm::dvec3& a0, const glm::dvec3& a1, const glm::dvec3& b1,
                const glm::dvec3& b0, double course, double patch, Random& random);

}  // namespace reflet::kit
