// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/Project.h"

#include <filesystem>

namespace reflet {

/// Reads and writes `name.reflet`. Saving is atomic: a temporary file beside the target, flushed to
/// the disk, then renamed over it; on any failure the old file is untouched and nothing is left.
[[nodiscard]] Result<Project> loadProject(const std::filesystem::path& path);
[[nodiscard]] Result<void> saveProject(const Project& project, const std::filesystem::path& path);

}  // namespace reflet
