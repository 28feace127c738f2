// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Files.h"
#include "core/io/RasterFile.h"
#include "importers/terrain/TerrainImporter.h"

#include <algorithm>
#include <sstream>
#include <system_error>

namespace reflet {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> ofFolder(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed))
        if (RasterFile::recognises(entry.path()))
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// The paths that a list holds; nothing when it is none.
std::vector<fs::path> ofList(const fs::path& list) {
    constexpr std::size_t kLongest = std::size_t(1) << 20;
    const auto text = readFile(list, kLongest);
    std::vector<fs::path> files;
    if (!text)
        return files;
    std::istringstream lines(*text);
    for (std::string line; std::getline(lines, line);) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' '))
            line.pop_back();
        if (line.empty() || line.front() == '#')
            continue;
        const fs::path path = list.parent_path() / line;
        std::error_code failed;
        if (files.empty() && (line.size() > 4096 || !fs::is_regular_file(path, failed)))
            return files;
        files.push_back(path.lexically_normal());
    }
    return files;
}

}  // namespace

Result<std::vector<fs::path>> rasterFiles(const fs::path& path) {
    std::error_code failed;
    if (fs::is_directory(path, failed)) {
        auto files = ofFolder(path);
        if (files.empty())
            return fail(ErrorCode::Unreadable, "there is no raster in this folder", path.string(),
                        "GeoTIFF, ASCII grids and XYZ work best.");
        return files;
    }
    if (!RasterFile::recognises(path)) {
        auto files = ofList(path);
        if (!files.empty())
            return files;
    }
    return std::vector<fs::path>{path};
}

}  // namespace reflet
