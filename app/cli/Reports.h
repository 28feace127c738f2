// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/Console.h"
#include "app/pipeline/LoadedCity.h"

namespace reflet::cli {

/// The keys of `info` and `import` in DESIGN section 7.
[[nodiscard]] nlohmann::json toJson(const FileReport& report);
/// One document for one file; `files` for several.
[[nodiscard]] nlohmann::json toJson(const std::vector<FileReport>& reports);
/// The same for people.
void print(const FileReport& report, const Console& console);

}  // namespace reflet::cli
