// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/Project.h"

#include <filesystem>
#include <string>

namespace reflet {

/// A path of a file that is relative to folder `from`, for folder `to`: relative where that can be,
/// '/' separated. An empty `from` leaves relative paths as they are (nobody knows where they
/// start); an empty `to` gives an absolute path.
[[nodiscard]] std::string rebasedPath(const std::string& path, const std::filesystem::path& from,
                                      const std::filesystem::path& to);

/// The same for all files that a project names, and for the text that it was read from.
void rebasePaths(Project& project, const std::filesystem::path& from,
                 const std::filesystem::path& to);
[[nodiscard]] std::string rebasedSource(const std::string& source,
                                        const std::filesystem::path& from,
                                        const std::filesystem::path& to);

}  // namespace reflet
