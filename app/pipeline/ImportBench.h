// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reflet {

/// A step on the way from a file to the first picture.
struct ImportStep {
    std::string name;
    double seconds = 0.0;
    double cpu = 0.0;  ///< processor time of all threads
};

struct ImportBenchReport {
    std::string format;
    std::size_t bytes = 0;
    std::size_t triangles = 0;  ///< of the city, with what lies under it
    /// "import": file to project and city; "prepare": heightfield and what is drawn of it.
    std::vector<ImportStep> steps;
    double total = 0.0;           ///< seconds of all steps
    std::optional<double> parse;  ///< seconds to parse the file alone (JSON formats)
    std::size_t peakBytes = 0;    ///< most memory of the process until now
    /// Seconds, by the moment as a share of all, from a request to cancel until all had returned.
    std::vector<std::pair<double, double>> cancels;
};

/// What opening a city model costs, without a window. Errors as importProject().
/// cancels: how many more times it is begun and cancelled, at equal steps on its way.
[[nodiscard]] Result<ImportBenchReport> benchImport(const std::filesystem::path& file, int cancels,
                                                    const JobContext& job);

}  // namespace reflet
