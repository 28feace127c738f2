// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/DistanceForms.h"
#include "core/environment/DistancePlan.h"

#include <cstddef>
#include <vector>

namespace reflet {

/// Which planes and blocks of a map get entries of DistanceBlocks: all that ask for them, or those
/// that do most for an entry.
struct DistanceBudget {
    /// `capacity`: entries that there are.
    DistanceBudget(const std::vector<DistanceFacePlan>& faces, std::size_t capacity);

    std::vector<std::vector<char>> hasPlane;              ///< by face and plane
    std::vector<std::vector<distance_forms::Form>> form;  ///< by face and block
};

}  // namespace reflet
