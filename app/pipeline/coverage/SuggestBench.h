// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/Suggest.h"

#include <filesystem>
#include <optional>

namespace reflet {

struct SuggestBenchOptions {
    std::optional<std::filesystem::path> project;  ///< nullopt: a city that is made for it
    std::size_t candidates = 10'000;               ///< about: sets the spacing along the routes
    std::size_t samples = 1'000'000;               ///< at most
    std::size_t count = 100;                       ///< probes that are placed
};

struct SuggestBenchReport {
    double seconds = 0.0;  ///< of suggestProbes(), without baselines
    double moveOne = 0.0;  ///< seconds until the coverage is known after a probe has moved: median
    std::size_t candidates = 0, samples = 0, probes = 0, triangles = 0;
    double routes = 0.0;                 ///< metres
    double coverage = 0.0, ratio = 0.0;  ///< after, and worth by its upper bound
};

/// Measures a suggestion, and what moving one of its probes costs (CoverageWatch on as many
/// samples). The city that is made has a square kilometre of blocks of houses with courtyards
/// between 26 streets of a kilometre each, the same always.
[[nodiscard]] Result<SuggestBenchReport> benchSuggest(const SuggestBenchOptions& options,
                                                      const JobContext& job);

/// CityJSON of that city: `blocks` by `blocks` blocks, 80 m from street to street, in EPSG:25832.
[[nodiscard]] std::string blockCity(int blocks);

}  // namespace reflet
