// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Files.h"

#include <algorithm>
#include <system_error>

namespace reflet {

namespace fs = std::filesystem;

namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool equalButForCase(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

/// "http:", "file:", "data:" (RFC 3986, section 3.1) and the drives of Windows, "C:".
bool hasScheme(std::string_view reference) {
    const auto colon = reference.find(':');
    if (colon == 0 || colon == std::string_view::npos)
        return false;
    const auto isLetter = [](char c) { return lower(c) >= 'a' && lower(c) <= 'z'; };
    const auto mayFollow = [&](char c) {
        return isLetter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
    };
    return isLetter(reference.front()) &&
           std::all_of(reference.begin(), reference.begin() + static_cast<std::ptrdiff_t>(colon),
                       mayFollow);
}

/// The entry of `folder` that `name` means: itself when it exists, else the first in byte order
/// that differs in case only, else `name` as it was written.
fs::path entryFor(const fs::path& folder, const fs::path& name) {
    std::error_code error;
    if (fs::exists(folder / name, error))
        return name;
    fs::path match;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const fs::path candidate = entry->path().filename();
        if (equalButForCase(candidate.native(), name.native()) &&
            (match.empty() || candidate < match))
            match = candidate;
    }
    return match.empty() ? name : match;
}

bool liesIn(const fs::path& folder, const fs::path& path) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
           folder.end();
}

}  // namespace

std::optional<fs::path> confinedPath(const fs::path& folder, std::string_view reference) {
    if (reference.empty() || reference.find('\0') != std::string_view::npos || hasScheme(reference))
        return std::nullopt;
    std::string slashed(reference);
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    const fs::path relative = fs::path(slashed).lexically_normal();
    if (relative.is_absolute() || *relative.begin() == "..")
        return std::nullopt;

    const fs::path base = folder.empty() ? fs::path(".") : folder;
    fs::path resolved = base;
    for (const fs::path& name : relative)
        resolved /= entryFor(resolved, name);

    // Symbolic links may lead anywhere: what counts is where the path ends.
    std::error_code error;
    const fs::path canonicalBase = fs::weakly_canonical(fs::absolute(base, error), error);
    if (error)
        return std::nullopt;
    const fs::path canonical = fs::weakly_canonical(fs::absolute(resolved, error), error);
    if (error || !liesIn(canonicalBase, canonical))
        return std::nullopt;
    return resolved;
}

}  // namespace reflet
