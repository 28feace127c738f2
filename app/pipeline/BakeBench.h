// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"

#include <cstddef>
#include <string>
#include <vector>

namespace reflet {

/// Baking at one resolution, each probe in a scene that knows no soft light yet but that of the
/// probes before it, as a project is baked.
struct BakeBenchSize {
    int resolution = 0;
    std::size_t probes = 0;
    double milliseconds = 0.0;   ///< a probe, median
    double first = 0.0;          ///< of the first, which finds no soft light at all
    double noting = 0.0;         ///< of the median: to note what a map depends on
    double raysPerSecond = 0.0;  ///< primary rays, of all probes together
};

/// All probes of the project, and again what one changed building asks for.
struct BakeBenchChange {
    std::string object;     ///< that was taken away
    std::size_t baked = 0;  ///< probes that depend on it
    double seconds = 0.0;   ///< to find them, and to bake them
};

struct BakeBenchReport {
    int threads = 1;
    std::size_t triangles = 0;
    std::vector<BakeBenchSize> sizes;
    int resolution = 0;      ///< of the project's probes, for what follows
    std::size_t probes = 0;  ///< without those that are refused
    double seconds = 0.0;    ///< for all of them
    std::vector<BakeBenchChange> changes;
};

struct BakeBenchOptions {
    std::vector<int> resolutions{64, 128, 256};
    std::size_t probes = 6;   ///< at each resolution, spread over the project's
    std::size_t changes = 5;  ///< buildings that are taken away, one by one
};

/// Bakes on the CPU, without the cache. Usage when the project has no probes; Refused when all of
/// them are; Cancelled.
[[nodiscard]] Result<BakeBenchReport> benchBake(const PreparedCity& city,
                                                const BakeBenchOptions& options,
                                                const JobContext& job);

}  // namespace reflet
