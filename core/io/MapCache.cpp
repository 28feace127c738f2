// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/MapCache.h"

#include "core/base/Files.h"
#include "core/io/ImageFile.h"

namespace reflet {

std::filesystem::path MapCache::pathOf(const std::string& key) const {
    return m_folder / "rem" / (key + ".exr");
}

bool MapCache::contains(const std::string& key) const {
    std::error_code error;
    return std::filesystem::is_regular_file(pathOf(key), error);
}

std::size_t MapCache::bytes(const std::string& key) const {
    std::error_code error;
    const auto size = std::filesystem::file_size(pathOf(key), error);
    return error ? 0 : static_cast<std::size_t>(size);
}

std::optional<ReferenceEnvironmentMap> MapCache::find(const std::string& key) const {
    if (!contains(key))
        return std::nullopt;
    auto map = readEnvironmentMap(pathOf(key));
    if (!map)
        return std::nullopt;
    return std::move(*map);
}

Result<void> MapCache::store(const std::string& key, const ReferenceEnvironmentMap& map) const {
    const std::filesystem::path path = pathOf(key);
    if (auto made = makeFolder(path.parent_path()); !made)
        return made;
    return writeEnvironmentMap(map.id, map.center, map.radiance, map.distance, path);
}

}  // namespace reflet
