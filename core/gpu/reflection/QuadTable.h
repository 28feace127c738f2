// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/Reconstruction.h"

#include <glm/vec4.hpp>

#include <array>
#include <vector>

namespace reflet {

/// The adaptive mesh of a local map as the GPU draws it: each leaf that holds the centre of a texel
/// becomes a rectangle of whole texels, the same texels that the CPU's resampler writes, so that no
/// rule of rasterisation decides about a border. Four vectors a leaf:
///   0  first column, first row, columns, rows after the last; + flags, see below
///   1  s0, t0, 1 / (s1 - s0), 1 / (t1 - t0): a texel's centre (s, t) to the leaf's (u, v)
///   2  1/z at the corners (s0,t0) (s1,t0) (s0,t1) (s1,t1); 0 = sky
///   3  weight of REM B at the same corners; that of A is 1 minus it
/// The first column carries flags in steps of kFlag: 1 = an uncovered vertex, 2 = the leaf of a
/// single texel with a ray of its own.
struct QuadTable {
    static constexpr int kFlag = 1 << 16;
    static constexpr int kVectors = 4;

    std::vector<glm::vec4> rows;
    std::array<int, 7> firstOfFace{};  ///< leaves of face f: [firstOfFace[f], firstOfFace[f + 1])
    ReconstructionStatistics statistics;
};

/// Builds the mesh of all six faces around a position on the CPU, in parallel. Milliseconds of the
/// statistics: of this alone.
[[nodiscard]] QuadTable buildQuadTable(const ReconstructionInput& input, const RemChoice& choice,
                                       const glm::dvec3& position, const MemSettings& settings);

}  // namespace reflet
