// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace reflet {

enum class Severity { Info, Warning, Error };

/// One remark on one object of an input, stable enough for programs to match on `code`.
struct Diagnostic {
    Severity severity = Severity::Warning;
    std::string code;    ///< stable, lower-case with dashes: "index-out-of-range"
    std::string object;  ///< id of the city object; empty when it is about the file
    std::string text;    ///< what was found and what was done
    std::string remedy;  ///< what the user can do; may be empty
};

/// "info", "warning" or "error", as in the JSON reports.
[[nodiscard]] const char* toString(Severity severity);

/// How the objects of an input fared. loaded + repaired + skipped = objects that were present.
struct ImportCounts {
    std::size_t loaded = 0;
    std::size_t repaired = 0;
    std::size_t skipped = 0;
};

/// A value read from a file, with an account of what happened to each object.
template <class T>
struct Imported {
    T value;
    ImportCounts counts;
    std::vector<Diagnostic> diagnostics;
};

}  // namespace reflet
