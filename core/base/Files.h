// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace reflet {

/// Reads a whole file. Unreadable when it cannot be read or is a directory; ResourceLimit above
/// `limit` bytes (checked before anything is allocated).
[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& path, std::size_t limit);

/// Lets `write` make a temporary file beside `path`, flushes it to the disk and renames it over
/// `path`. On any failure the old file is untouched and nothing partial is left behind.
[[nodiscard]] Result<void> writeAtomically(
    const std::filesystem::path& path,
    const std::function<Result<void>(const std::filesystem::path&)>& write);
/// The same for bytes that are at hand. WriteFailed names the path and the system's reason.
[[nodiscard]] Result<void> writeFileAtomically(const std::filesystem::path& path,
                                               std::string_view bytes);

/// Makes a folder and those above it. WriteFailed with the system's reason and a remedy.
[[nodiscard]] Result<void> makeFolder(const std::filesystem::path& folder);

/// `reference` resolved against `folder` and confined to it: nullopt for absolute paths, URLs,
/// paths (or symbolic links) that lead out of the folder. Backslashes count as slashes; when the
/// name as written does not exist, a match that differs in case only is taken.
[[nodiscard]] std::optional<std::filesystem::path> confinedPath(const std::filesystem::path& folder,
                                                                std::string_view reference);

}  // namespace reflet
