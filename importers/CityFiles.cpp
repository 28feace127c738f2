// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/CityFiles.h"

#include "core/base/Files.h"
#include "core/io/RasterFile.h"
#include "importers/FormatRegistry.h"
#include "importers/terrain/TerrainImporter.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <system_error>

namespace reflet {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostEntries = 200'000;

Result<std::vector<fs::path>> filesBelow(const fs::path& folder, const JobContext& job) {
    std::vector<fs::path> files;
    std::size_t entries = 0;
    std::error_code error;
    constexpr auto kOptions = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator entry(folder, kOptions, error), end;
         !error && entry != end; entry.increment(error)) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        if (++entries > kMostEntries)
            return fail(ErrorCode::ResourceLimit,
                        fmt::format("holds more than {} files and folders", kMostEntries),
                        folder.string(), "Name the folder in which the city models lie.");
        std::error_code ignored;
        const bool hidden = entry->path().filename().string().starts_with('.');
        if (hidden && entry->is_directory(ignored))
            entry.disable_recursion_pending();
        else if (!hidden && entry->is_regular_file(ignored))
            files.push_back(entry->path());
    }
    if (error)
        return fail(ErrorCode::Unreadable, "cannot be read: " + error.message(), folder.string(),
                    "Check the name and the permissions.");
    std::sort(files.begin(), files.end());
    return files;
}

/// A raster that says where it lies: others are pictures on the walls of city models.
bool isPlacedRaster(const fs::path& path) {
    const auto raster = RasterFile::open(path);
    return raster && raster->info().placed;
}

/// What stands for rasters that lie directly in one folder and are of one use.
bool standTogether(const std::vector<fs::path>& rasters, const fs::path& folder) {
    const RasterUse use = rasterUse(rasters.front());
    const auto inside = rasterFiles(folder);
    return inside && *inside == rasters &&
           std::all_of(rasters.begin(), rasters.end(), [&](const fs::path& raster) {
               return raster.parent_path() == folder && rasterUse(raster) == use;
           });
}

/// Of tilesets that lie in one folder or below each other, which refer to each other, the
/// tileset.json of the outermost, or the first in it. What lies below is theirs.
void keepOutermost(std::vector<fs::path>& tilesets, std::vector<fs::path>& others) {
    const auto depth = [](const fs::path& path) {
        return std::pair(std::distance(path.begin(), path.end()),
                         path.filename() != "tileset.json");
    };
    std::stable_sort(tilesets.begin(), tilesets.end(),
                     [&](const fs::path& a, const fs::path& b) { return depth(a) < depth(b); });
    std::vector<fs::path> kept;
    const auto isTheirs = [&](const fs::path& file) {
        return std::any_of(kept.begin(), kept.end(), [&](const fs::path& outer) {
            const std::string below = file.lexically_relative(outer.parent_path()).string();
            return !below.empty() && !below.starts_with("..");
        });
    };
    for (const fs::path& tileset : tilesets) {
        if (!isTheirs(tileset))
            kept.push_back(tileset);
    }
    std::erase_if(others, isTheirs);
    tilesets = std::move(kept);
}

Diagnostic passedOver(const std::vector<fs::path>& files, const fs::path& folder) {
    constexpr std::size_t kNamed = 3;
    std::string names;
    for (std::size_t i = 0; i < std::min(files.size(), kNamed); ++i)
        names += fmt::format("{}{:.80}", i == 0 ? "" : ", ",
                             files[i].lexically_relative(folder).string());
    return {Severity::Info, "files-passed-over", folder.string(),
            fmt::format("{} files are no city models and were passed over: {}{}", files.size(),
                        names, files.size() > kNamed ? ", ..." : ""),
            ""};
}

/// Gathers what was named.
class Gatherer {
public:
    explicit Gatherer(const JobContext& job) : m_job(job) {}

    Result<void> add(const fs::path& path, bool listsToo) {
        const std::string name = path.string();
        std::error_code ignored;
        const bool there = fs::exists(path, ignored);
        if (listsToo && name.size() > 1 && name.front() == '@' && !there)
            return addList(name.substr(1));
        if (fs::is_directory(path, ignored))
            return addFolder(path);
        if (name.find_first_of("*?[") != std::string::npos && !there)
            return addPattern(path);
        take(path);
        return {};
    }
    [[nodiscard]] CityFiles result() && { return std::move(m_out); }

private:
    void take(const fs::path& path) {
        std::error_code error;
        const fs::path whole = fs::weakly_canonical(path, error);
        if (m_known.insert(error ? path : whole).second)
            m_out.files.push_back(path);
    }

    Result<void> addFolder(const fs::path& folder) {
        auto found = cityFilesIn(folder, m_job);
        if (!found)
            return tl::unexpected(found.error());
        for (const fs::path& file : found->files)
            take(file);
        std::move(found->remarks.begin(), found->remarks.end(), std::back_inserter(m_out.remarks));
        return {};
    }

    Result<void> addPattern(const fs::path& pattern) {
        glob_t matches{};
        std::vector<std::string> names;
        const int state = ::glob(pattern.c_str(), 0, nullptr, &matches);
        for (std::size_t i = 0; state == 0 && i < matches.gl_pathc; ++i)
            names.emplace_back(matches.gl_pathv[i]);
        ::globfree(&matches);
        if (names.empty())
            return fail(ErrorCode::Unreadable, "matches no file", pattern.string(),
                        "Check the pattern and the folder.");
        for (const std::string& name : names) {
            if (auto added = add(name, false); !added)
                return added;
        }
        return {};
    }

    Result<void> addList(const fs::path& list) {
        constexpr std::size_t kLargestList = std::size_t(16) << 20;
        const auto text = readFile(list, kLargestList);
        if (!text)
            return tl::unexpected(text.error());
        std::istringstream lines(*text);
        const std::size_t before = m_out.files.size();
        for (std::string line; std::getline(lines, line);) {
            line.erase(line.find_last_not_of(" \t\r") + 1);
            if (line.empty() || line.front() == '#')
                continue;
            if (auto added = add(list.parent_path() / line, false); !added)
                return added;
        }
        if (m_out.files.size() == before)
            return fail(ErrorCode::Unreadable, "names no file", list.string(),
                        "Write the name of one file on each line.");
        return {};
    }

    const JobContext& m_job;
    CityFiles m_out;
    std::set<fs::path> m_known;
};

}  // namespace

Result<CityFiles> cityFilesIn(const fs::path& folder, const JobContext& job) {
    const auto all = filesBelow(folder, job);
    if (!all)
        return tl::unexpected(all.error());
    CityFiles out;
    std::vector<fs::path> models, tilesets, rasters, others;
    for (const fs::path& file : *all) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        switch (placeInFolder(file)) {
            case PlaceInFolder::City:
                models.push_back(file);
                break;
            case PlaceInFolder::Tileset:
                tilesets.push_back(file);
                break;
            case PlaceInFolder::Raster:
                (isPlacedRaster(file) ? rasters : others).push_back(file);
                break;
            case PlaceInFolder::Other:
                others.push_back(file);
                break;
        }
    }
    keepOutermost(tilesets, others);
    models.insert(models.end(), tilesets.begin(), tilesets.end());
    if (models.empty() && rasters.empty())
        return fail(ErrorCode::Unreadable, "has no city models in it", folder.string(),
                    "Name the files, or the folder in which they lie.");
    if (models.empty() && standTogether(rasters, folder)) {
        out.files.push_back(folder);
    } else {
        out.files = std::move(models);
        out.files.insert(out.files.end(), rasters.begin(), rasters.end());
    }
    if (!others.empty())
        out.remarks.push_back(passedOver(others, folder));
    return out;
}

Result<CityFiles> cityFilesOf(const std::vector<fs::path>& named, const JobContext& job) {
    Gatherer gatherer(job);
    for (const fs::path& path : named) {
        if (auto added = gatherer.add(path, true); !added)
            return tl::unexpected(added.error());
    }
    return std::move(gatherer).result();
}

}  // namespace reflet
