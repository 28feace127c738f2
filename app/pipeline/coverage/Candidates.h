// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoveragePlan.h"
#include "core/base/Diagnostic.h"

#include <vector>

namespace reflet {

/// Places where a probe may be put, project frame.
struct Candidates {
    std::vector<glm::dvec3> places;
    std::vector<Diagnostic> remarks;  ///< how many were left out, by reason
};

/// Every `spacing` metres along the lines (or over the ground) at body-centre height; streets that
/// routes share once. What would stand in a solid is moved to the nearest free place, by 45 % of
/// the spacing at most, else left out; so is what lies in a circle without probes.
[[nodiscard]] Result<Candidates> probeCandidates(const PreparedCity& city, const CoveragePlan& plan,
                                                 double spacing, const JobContext& job);

/// Evenly spaced places along the lines, `count` in all, in the middle of as many equal parts; on
/// ground, of the order of its places. Free as above where that is possible.
[[nodiscard]] std::vector<glm::dvec3> evenPlaces(const CoveragePlan& plan, std::size_t count);

/// Where lines meet, end or turn by more than 45 degrees within 15 m; none nearer to another than
/// 10 m.
[[nodiscard]] std::vector<glm::dvec3> junctionPlaces(const CoveragePlan& plan);

}  // namespace reflet
