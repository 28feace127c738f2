// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/Error.h"
#include "core/base/JobContext.h"

#include <filesystem>
#include <vector>

namespace reflet {

/// Files that make up a city.
struct CityFiles {
    std::vector<std::filesystem::path> files;
    std::vector<Diagnostic> remarks;  ///< what was passed over
};

/// The city models, and the rasters that say where they lie, in a folder and those below it, by
/// their paths in ascending order; rasters alone are the folder itself where all are heights or all
/// are pictures. Links to folders and hidden names are not followed. Unreadable for a folder with
/// neither, ResourceLimit for one with more than 200,000 entries, Cancelled.
[[nodiscard]] Result<CityFiles> cityFilesIn(const std::filesystem::path& folder,
                                            const JobContext& job);

/// The files that a user means: a folder stands for those in it; "@list" for the names in that
/// text file, one a line, relative to its folder (lines that begin with # are remarks); a pattern
/// with *, ? or [ for all files that match it; what is named twice counts once. Unreadable for a
/// folder without city models, a list that cannot be read and a pattern that nothing matches; a
/// plain file is handed on, whether it is there or not.
[[nodiscard]] Result<CityFiles> cityFilesOf(const std::vector<std::filesystem::path>& named,
                                            const JobContext& job);

}  // namespace reflet
