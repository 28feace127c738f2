// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace reflet {

/// Writes a built-in sample city and its project into a folder (made if needed); files of the same
/// names are replaced. Returns the project's path.
[[nodiscard]] Result<std::filesystem::path> writeSample(const std::string& name, std::uint64_t seed,
                                                        const std::filesystem::path& folder);

}  // namespace reflet
