// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/coverage/CoverageColor.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace reflet {

/// A stretch of a route and how well the probes cover it, 0..1.
struct CoveredBand {
    std::vector<glm::dvec3> line;  ///< project frame, on the running surface
    double coverage = 0.0;
};

/// A piece of a façade that vehicles mirror, and how well the probes cover it, 0..1.
struct CoveredSpot {
    glm::dvec3 middle{0.0};  ///< project frame
    glm::vec3 normal{0.0F};  ///< unit
    double halfEdge = 1.0;   ///< metres
    double coverage = 0.0;
};

/// A probe that is suggested and does not exist yet.
struct GhostProbe {
    std::string id;
    glm::dvec3 position{0.0};  ///< project frame
    int number = 1;            ///< place in the order of the suggestion, from 1
    double gain = 0.0;         ///< coverage that it adds, 0..1

    friend bool operator==(const GhostProbe&, const GhostProbe&) = default;
};

/// What is drawn of a coverage over the city and in the plan: a value that never changes.
struct CoverageOverlay {
    std::vector<CoveredBand> bands;
    std::vector<CoveredSpot> spots;
    std::vector<GhostProbe> ghosts;
};

/// What is covered less is hatched, or hollow, as well as dark.
inline constexpr double kPoorlyCovered = 0.5;

/// The colour of what is suggested.
inline constexpr glm::vec3 kGhostColor{0.8F, 0.475F, 0.655F};

}  // namespace reflet
