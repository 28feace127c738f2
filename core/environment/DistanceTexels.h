// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/DistanceForms.h"

#include <array>
#include <cstdint>

namespace reflet {

/// Something for each of the 16 texels of a block, row by row.
using TexelFloats = std::array<float, 16>;

/// What the 16 texels of a block should say, and by how many metres planes miss it.
class DistanceTexels {
public:
    static constexpr float kMostError = 0.5f;  ///< what a texel's error counts at most

    /// lengths: of the texels' directions, scaled to 1 along the face's axis. distances: metres;
    /// not finite or not positive: sky.
    DistanceTexels(const TexelFloats& lengths, const TexelFloats& distances);

    [[nodiscard]] bool isSky() const;
    /// The plane that errs least, by least squares; a = 0 where there is none.
    [[nodiscard]] distance_forms::Plane fit() const;
    /// Errors of a plane that is told from a block `columns` and `rows` after this one.
    [[nodiscard]] TexelFloats errors(const distance_forms::Plane& plane, int columns,
                                     int rows) const;
    [[nodiscard]] TexelFloats errorsOfSky() const;
    /// Whether all texels are right: sky as sky, others to 2 cm and 2 · 10^-4 of the distance,
    /// at most a quarter of a metre.
    [[nodiscard]] bool areRight(const TexelFloats& errors) const;
    /// The same for a plane; faster where they are not.
    [[nodiscard]] bool areRight(const distance_forms::Plane& plane, int columns, int rows) const;
    /// 1/z of a row in 16 bits each.
    [[nodiscard]] std::uint64_t listedRow(std::size_t row) const;

private:
    [[nodiscard]] float errorOf(std::size_t texel, float inverse) const;
    [[nodiscard]] float tolerance(std::size_t texel) const;

    TexelFloats m_lengths, m_distances, m_inverse;  ///< 1/z, 0 for sky
};

}  // namespace reflet
