// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Random.h"
#include "core/samples/kit/Shapes.h"

#include <span>

namespace reflet::kit {

/// A raised pavement: kerb faces from z0 to z1, a border of granite, an inside of stone flags of
/// several tones. Flags are `flag` metres long and half as wide; 0 = one flat tone.
void pavement(Mesh& mesh, const Plot& plot, double z0, double z1, double flag, Random& random);
/// Rows of squares in two tones, tipped diagonally or straight, within a plot, with a frame of
/// granite around. Squares are cut out of each other: one layer at height z.
void checkerboard(Mesh& mesh, const Plot& plot, double z, double square, Paint light, Paint dark,
                  SurfaceType surface);
/// White stripes across a street: stripes run along x (or y).
void zebra(Mesh& mesh, const Plot& plot, double z, bool stripesAlongX);
/// Dashes of a lane marking from a to b.
void dashes(Mesh& mesh, const glm::dvec2& a, const glm::dvec2& b, double z);

/// A strip along a line: left and right edges at the offsets (left positive), at height z.
void ribbon(Mesh& mesh, std::span<const glm::dvec2> line, double right, double left, double z,
            Skin skin);
/// An upright face along a line at an offset, facing left (or right).
void ribbonEdge(Mesh& mesh, std::span<const glm::dvec2> line, double offset, double z0, double z1,
                bool facesLeft, Skin skin);
/// A point of the line's parallel at an offset (left positive), mitred.
[[nodiscard]] glm::dvec2 parallelPoint(std::span<const glm::dvec2> line, std::size_t i,
                                       double offset);

/// Two tracks in a paved bed along a line: bed with edges, setts between the rails, rails.
struct TrackStyle {
    double base = 0.0;       ///< height of the ground beside it
    double bed = 0.06;       ///< height of the bed's top
    double rail = 0.08;      ///< height of the rails' tops: the running surface
    double spacing = 3.4;    ///< between the tracks' axes
    double halfWidth = 3.4;  ///< of the bed
};
void tramTracks(Mesh& mesh, std::span<const glm::dvec2> axis, const TrackStyle& style);

}  // namespace reflet::kit
