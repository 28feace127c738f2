// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/ContentHash.h"
#include "core/base/Error.h"

#include <filesystem>

namespace reflet {

/// Adds the bytes of a file with their number, read piece by piece. Unreadable as by readFile().
[[nodiscard]] Result<void> addFileBytes(ContentHash& hash, const std::filesystem::path& path);

}  // namespace reflet
