// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/Reconstruction.h"

#include <glm/vec4.hpp>

#include <vector>

namespace reflet {

/// The adaptive mesh of a local map as the GPU draws it: each leaf that holds the centre of a texel
/// becomes a rectangle of whole texels, the same texels that the CPU's resampler writes, so that no
/// rule of rasterisation decides about a border. A leaf is drawn once for each REM that serves one
/// of its corners, and what they give is added up. Four vectors for each of these looks:
///   0  first column, first row, columns, rows after the last; + flags, see below
///   1  s0, t0, 1 / (s1 - s0), 1 / (t1 - t0): a texel's centre (s, t) to the leaf's (u, v)
///   2  1/z at the corners (s0,t0) (s1,t0) (s0,t1) (s1,t1); 0 = sky
///   3  weight of the REM at the same corners
/// The first column carries flags in steps of kFlag: 1 = an uncovered vertex, 2 = the leaf of a
/// single texel with a ray of its own.
struct QuadTable {
    static constexpr int kFlag = 1 << 16;
    static constexpr int kVectors = 4;

    /// The looks of one face through one REM.
    struct Stretch {
        int face = 0;
        int candidate = -1;  ///< index into RemCandidates::rems; -1 = leaves that no REM serves
        int first = 0;       ///< look
        int count = 0;
    };

    std::vector<glm::vec4> rows;
    std::vector<Stretch> stretches;  ///< by face, then candidate; none is empty
    ReconstructionStatistics statistics;
};

/// Builds the mesh of all six faces around a position on the CPU, in parallel. Milliseconds of the
/// statistics: of this alone.
[[nodiscard]] QuadTable buildQuadTable(const ReconstructionInput& input,
                                       const RemCandidates& candidates, const glm::dvec3& position,
                                       const MemSettings& settings);

}  // namespace reflet
