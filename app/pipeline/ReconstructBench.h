// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/traffic/Traffic.h"

#include <cstddef>
#include <string>
#include <vector>

namespace reflet {

/// What a local map costs by one method with one tuning: medians over the maps.
struct ReconstructCase {
    std::string name;
    double ours = 0.0;       ///< milliseconds
    double reference = 0.0;  ///< milliseconds of the same map traced anew with Embree and shaded
    double rays = 0.0;
    double quads = 0.0;

    [[nodiscard]] double ratio() const { return ours > 0.0 ? reference / ours : 0.0; }
};

struct ReconstructBenchReport {
    int threads = 1;
    int resolution = 0;
    std::size_t maps = 0;
    std::vector<ReconstructCase> cases;
};

/// Centres of local maps: those of every body, at `positions` places spread over the routes.
[[nodiscard]] std::vector<glm::dvec3> mapCenters(const Traffic& traffic, int positions);

/// Makes local maps by all methods of the CPU at `positions` places along the routes (1..1000), all
/// methods at one place after the other, so that a busy machine is busy for all. Each is made once
/// before, so that nothing is measured that is made but once. Usage when nothing drives or there
/// are no probes; Cancelled. Places where the reference is refused (inside a wall) are left out.
[[nodiscard]] Result<ReconstructBenchReport> benchReconstruct(const PreparedCity& city,
                                                              const RemSet& rems,
                                                              const Traffic& traffic, int positions,
                                                              const JobContext& job);

}  // namespace reflet
