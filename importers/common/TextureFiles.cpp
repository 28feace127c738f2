// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/TextureFiles.h"

#include "core/base/Files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_map>

namespace reflet::importers {

namespace fs = std::filesystem;

namespace {

enum class Found { Here, Missing, Remote, Absolute, Outside, Unnamed, Broken };
constexpr std::size_t kFounds = 7;

bool isUrl(std::string_view reference) {
    const std::size_t colon = reference.find(':');
    if (colon == std::string_view::npos || colon < 2)  // one letter is a drive
        return false;
    return std::all_of(
        reference.begin(), reference.begin() + static_cast<std::ptrdiff_t>(colon),
        [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '.' || c == '-'; });
}

bool isAbsolute(std::string_view reference) {
    return reference.front() == '/' || reference.front() == '\\' ||
           (reference.size() > 1 && reference[1] == ':');
}

bool leadsUp(std::string_view reference) {
    std::size_t begin = 0;
    while (begin <= reference.size()) {
        const std::size_t end = std::min(reference.find_first_of("/\\", begin), reference.size());
        if (reference.substr(begin, end - begin) == "..")
            return true;
        begin = end + 1;
    }
    return false;
}

bool isFile(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error) && !error;
}

Found resolve(const fs::path& folder, const std::string& reference, std::string& path) {
    if (reference.empty() || reference.find('\0') != std::string::npos)
        return Found::Unnamed;
    if (isUrl(reference))
        return Found::Remote;
    if (isAbsolute(reference))
        return Found::Absolute;
    if (leadsUp(reference))
        return Found::Outside;
    for (const fs::path& place : {folder, folder / "appearances"}) {
        const auto candidate = confinedPath(place, reference);
        if (candidate && isFile(*candidate)) {
            path = candidate->string();
            return Found::Here;
        }
    }
    return Found::Missing;
}

struct Reason {
    Found found;
    const char* code;
    const char* text;
    const char* remedy;
};

constexpr std::array<Reason, 6> kReasons{{
    {Found::Missing, "texture-missing", "not found beside the file",
     "Put the images where the file names them, or into a folder \"appearances\" beside it."},
    {Found::Remote, "texture-remote", "named by a URL, and nothing is fetched from a network",
     "Download the images and name them relative to the file."},
    {Found::Absolute, "texture-absolute", "named by an absolute path, which is not followed",
     "Name the images relative to the file."},
    {Found::Outside, "texture-outside", "named by a path that leads out of the file's folder",
     "Put the images into the file's folder and name them relative to it."},
    {Found::Unnamed, "texture-unnamed", "given without a usable name", "Export the file again."},
    {Found::Broken, "texture-broken", "embedded, but no PNG or JPEG where the file says",
     "Export the file again with images as PNG or JPEG."},
}};

/// One diagnostic for each reason: a city may miss thousands of images for the same one.
class LostImages {
public:
    void add(Found found, const std::string& reference) {
        Lost& lost = m_lost[static_cast<std::size_t>(found)];
        constexpr std::size_t kNamed = 3;
        if (lost.count++ < kNamed)
            lost.names += fmt::format("{}{:.80}", lost.names.empty() ? "" : ", ", reference);
    }
    void report(std::size_t total, std::vector<Diagnostic>& into) const {
        for (const Reason& reason : kReasons) {
            const Lost& lost = m_lost[static_cast<std::size_t>(reason.found)];
            if (lost.count == 0)
                continue;
            into.push_back({Severity::Warning, reason.code, "",
                            fmt::format("{} of {} texture images {} {}: {}{}", lost.count, total,
                                        lost.count == 1 ? "is" : "are", reason.text, lost.names,
                                        lost.count > 3 ? ", ..." : ""),
                            reason.remedy});
        }
    }

private:
    struct Lost {
        std::size_t count = 0;
        std::string names;
    };
    std::array<Lost, kFounds> m_lost;
};

fs::path folderOf(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

std::optional<fs::path> textureFile(const std::string& image, const fs::path& path) {
    std::string found;
    if (resolve(folderOf(path), image, found) != Found::Here)
        return std::nullopt;
    return fs::path(found);
}

std::vector<CityTexture> resolveTextures(const std::vector<TextureEntry>& entries,
                                         const fs::path& path,
                                         std::vector<Diagnostic>& diagnostics) {
    const fs::path folder = folderOf(path);
    std::unordered_map<std::string, std::string> resolved;
    LostImages lost;
    std::vector<CityTexture> textures;
    textures.reserve(entries.size());
    for (const TextureEntry& entry : entries) {
        const auto [known, isNew] = resolved.try_emplace(entry.image);
        if (isNew) {
            Found found = Found::Here;
            if (!entry.embedded)
                found = resolve(folder, entry.image, known->second);
            else if ((known->second = entry.path).empty())
                found = Found::Broken;
            if (found != Found::Here)
                lost.add(found, entry.image);
        }
        textures.push_back(
            {entry.image, known->second, entry.repeat, {}, entry.embedded, entry.alpha});
    }
    lost.report(resolved.size(), diagnostics);
    return textures;
}

}  // namespace reflet::importers
