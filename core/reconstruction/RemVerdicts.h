// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/Reconstruction.h"

#include <vector>

namespace reflet {

/// Why a REM has its share of what a vehicle shows in a direction, or none.
struct RemVerdict {
    enum class Reason {
        Shown,   ///< it has a weight
        Hidden,  ///< something stands between it and what is seen there
        Angle,   ///< sees it from another side than the vehicle, more so than the one that shows it
        Farther,  ///< stands farther away than the one that shows it
    };
    std::size_t rem = 0;  ///< index into the set
    Reason reason = Reason::Shown;
    double weight = 0.0;    ///< 0..1; all of them sum to 1
    double distance = 0.0;  ///< metres from the vehicle
    double angle = 0.0;  ///< radians, at what is seen, between the vehicle and the REM; 0 for sky
};

/// What a vehicle at a place shows in one direction, and who shows it.
struct DirectionVerdict {
    bool sky = false;
    glm::dvec3 point{0.0};         ///< what is seen there; meaningless for sky
    bool uncovered = false;        ///< no REM sees it: the one that is shown shows something else
    std::vector<RemVerdict> rems;  ///< those with a weight, the largest first; then others, by
                                   ///< their distance: candidates and the nearest ones
};

/// direction: of any length above 0, project frame.
[[nodiscard]] DirectionVerdict explainDirection(const ReconstructionInput& input,
                                                const glm::dvec3& position,
                                                const glm::dvec3& direction,
                                                const MemSettings& settings);

}  // namespace reflet
