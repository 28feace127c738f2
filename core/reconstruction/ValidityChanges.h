// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/Reconstruction.h"

#include <cstddef>

namespace reflet {

/// How often two sets of the same REMs, with distances that differ a little, disagree on whether a
/// REM is valid for what a texel of a local map shows.
struct ValidityChanges {
    std::size_t texels = 0;
    std::size_t changedTexels = 0;  ///< with at least one changed decision
    std::size_t decisions = 0;      ///< of REMs that were asked for, texel by texel
    std::size_t changedDecisions = 0;

    ValidityChanges& operator+=(const ValidityChanges& other);
};

/// For the map around a position with a ray for each texel. Both sets hold as many REMs, at the
/// same places; input's says which of them serve.
[[nodiscard]] ValidityChanges validityChanges(const ReconstructionInput& input, const RemSet& other,
                                              const glm::dvec3& position,
                                              const MemSettings& settings);

}  // namespace reflet
