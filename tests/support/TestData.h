// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace reflet::test {

/// A file or folder below the shared data that lie beside the checkout (`../shared/data`, or the
/// folder that the environment variable REFLET_SHARED_DATA names); nullopt when it is not there.
/// Usage: `const auto path = sharedData("cityjson"); if (!path) GTEST_SKIP() << kNoSharedData;`
[[nodiscard]] inline std::optional<std::filesystem::path> sharedData(
    const std::filesystem::path& relative = {}) {
    const char* named = std::getenv("REFLET_SHARED_DATA");
    const std::filesystem::path root =
        named != nullptr && *named != '\0'
            ? std::filesystem::path(named)
            : std::filesystem::path(REFLET_SOURCE_DIR) / ".." / "shared" / "data";
    const std::filesystem::path path = relative.empty() ? root : root / relative;
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        return std::nullopt;
    return path;
}

inline constexpr const char* kNoSharedData =
    "The shared data are absent; set REFLET_SHARED_DATA to their folder to run this test.";

}  // namespace reflet::test
