// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/Reconstruction.h"

#include <array>
#include <optional>

namespace reflet {

/// A box around a REM's centre, upright and turned about z: what box projection, as game engines
/// do it, takes for the city's shape.
struct FittedBox {
    double yaw = 0.0;  ///< radians from east to the box's first axis, in [0, π/2)
    /// Metres from the centre to the planes along +u −u +v −v +z −z, u being the first axis and
    /// v = z × u; +infinity where the box is open.
    std::array<double, 6> distance{kInfinity, kInfinity, kInfinity,
                                   kInfinity, kInfinity, kInfinity};
};

/// The box that the REM's own distances show (DESIGN 5.8). For each of 18 turns of the axes, every
/// direction goes to the side that it meets, and the side lies at the median of the points hit
/// there, weighted by solid angle, so that a lamp post or a gap moves no wall; this is repeated
/// thrice. The turn with the least mean |log(box distance / REM distance)| is taken. A side that
/// mostly shows sky is open. A REM without any surface gives a box open on all sides.
[[nodiscard]] FittedBox fitBox(const ReferenceEnvironmentMap& rem);

/// Where a ray from a point leaves the box, both as vectors from the REM's centre; nullopt through
/// an open side. A point outside the box is taken to stand just inside of it.
[[nodiscard]] std::optional<glm::dvec3> leaveBox(const FittedBox& box,
                                                 const glm::dvec3& pointFromCenter,
                                                 const glm::dvec3& direction);

/// Baseline: the nearest REM looked up where the ray from P leaves the REM's box. Directions that
/// show sky there stay at infinity. Distances are those to the box. The boxes are thought to be
/// fitted beforehand: statistics count the time of the map alone. No REM at all: as
/// reconstructNearest. sources: where each texel's radiance comes from, if not null.
[[nodiscard]] LocalEnvironmentMap reconstructBox(const ReconstructionInput& input,
                                                 const glm::dvec3& position, int resolution,
                                                 TexelSources* sources = nullptr);

}  // namespace reflet
