// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/Error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// Text of the JSON Schema (draft 7) of project files, as published in resources/schema.
[[nodiscard]] const std::string& projectSchema();

struct ValidationReport {
    bool valid = false;
    std::vector<Diagnostic> findings;  ///< object = JSON pointer or file
};

/// Checks a project file against the published schema, reads it as Reflet would, and looks whether
/// every file that it names is there and unchanged. A project that is not sound is a report, not an
/// error; Unreadable only when the file itself cannot be read or is no JSON.
[[nodiscard]] Result<ValidationReport> validateProject(const std::filesystem::path& path);

}  // namespace reflet
