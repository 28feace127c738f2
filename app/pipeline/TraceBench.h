// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

struct TraceBenchOptions {
    /// Projects or city models; none: the sample "paper" and the same with ten times the triangles.
    std::vector<std::filesystem::path> files;
    int poses = 64;               ///< positions of vehicles in each city, at least 1
    std::size_t checkedRays = 0;  ///< random rays of each city to compare with the oracle
};

/// How fast the same rays were traced, in million rays a second.
struct TraceRates {
    std::size_t rays = 0;
    double heightfield = 0.0;  ///< many at a time, as reconstructions do
    double scalar = 0.0;       ///< one by one
    double single = 0.0;       ///< Embree, in the city's mesh: ray by ray and in packets, told that
    double packet8 = 0.0;      ///< they are alike where that is faster
    double packet16 = 0.0;

    [[nodiscard]] double best() const { return std::max({single, packet8, packet16}); }
    /// Of the heightfield to Embree's best.
    [[nodiscard]] double ratio() const { return best() > 0.0 ? heightfield / best() : 0.0; }
};

/// On all threads and on one.
struct TraceThreads {
    TraceRates all;
    TraceRates one;
};

struct TraceBenchScene {
    std::string name;
    std::size_t triangles = 0;
    std::size_t compared = 0;    ///< rays, of those below and random ones
    std::size_t mismatches = 0;  ///< answers that are not the oracle's, bit for bit
    TraceThreads vertices;       ///< of the adaptive meshes of local maps
    TraceThreads texels;         ///< all of the six faces, 128 × 128 each
};

struct TraceBenchReport {
    int threads = 1;
    std::vector<TraceBenchScene> scenes;
};

/// Traces rays from where the vehicles' local maps are centred, through the heightfield and, with
/// Embree, through the mesh. A city without vehicles is looked at from its open ground. Errors as
/// of reading projects and cities; Cancelled.
[[nodiscard]] Result<TraceBenchReport> benchTrace(const TraceBenchOptions& options,
                                                  const JobContext& job);

}  // namespace reflet
