// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/environment/EnvironmentMap.h"
#include "core/traffic/Traffic.h"

#include <vector>

namespace reflet {

/// Where a reflector is compared, and the reference of each of its bodies.
struct ComparedPose {
    std::size_t reflector = 0;
    double time = 0.0;  ///< seconds
    PlacedReflector placed;
    std::vector<LocalEnvironmentMap> truth;

    /// The reflector first, then the other vehicles as they stand when it is there.
    [[nodiscard]] std::vector<PlacedReflector> withOthers(const Traffic& traffic) const;
};

/// Those that mirror anything: people don't.
[[nodiscard]] std::vector<std::size_t> mirrorsOf(const Traffic& traffic);

/// Poses at equal steps along each route, never nearer to its ends than half the vehicle. The
/// references are not traced yet.
[[nodiscard]] std::vector<ComparedPose> spreadPoses(const Traffic& traffic, int count);

/// Traces the reference of each body; poses where that is refused (inside a wall) are left out,
/// with a remark.
[[nodiscard]] Result<void> traceReferences(const PreparedCity& city, const Traffic& traffic,
                                           std::vector<ComparedPose>& poses,
                                           std::vector<Diagnostic>& remarks, const JobContext& job);

}  // namespace reflet
