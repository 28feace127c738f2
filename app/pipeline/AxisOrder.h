// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/project/Project.h"

#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// The project with city models whose coordinates are read in another order: "en" (east first) or
/// "ne" (north first). Where the project's origin came from one of them, it is found anew; and what
/// stands in a project whose whole city changes sides with that (probes, routes, views) comes
/// along. `models`: paths as the project has them, or the ends of them; "" = the only one. Usage
/// for an unknown model or order, Refused for rasters, whose order GDAL knows. `folder` is where
/// the project's file lies.
[[nodiscard]] Result<Project> withAxisOrder(Project project, const std::vector<std::string>& models,
                                            const std::string& order,
                                            const std::filesystem::path& folder,
                                            const JobContext& job);

}  // namespace reflet
