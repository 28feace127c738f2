// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Compare.h"

#include <filesystem>
#include <vector>

namespace reflet {

/// The figures with probes at one spacing.
struct SpacingRow {
    double metres = 0.0;
    std::size_t probes = 0;
    CompareReport report;
};

/// Compares methods with the project's probes replaced by others at each of these spacings (metres)
/// along the routes that vehicles drive, as `edit --probes-every` places them: what one probe more
/// is worth. The project is not changed; its cache keeps the maps that are baked. Over local maps
/// alone, at the same poses for all. Usage when a spacing is out of range or nothing was given.
[[nodiscard]] Result<std::vector<SpacingRow>> compareSpacings(
    const PreparedCity& city, const std::filesystem::path& projectFile,
    const std::vector<double>& spacings, const CompareOptions& options, const JobContext& job);

}  // namespace reflet
