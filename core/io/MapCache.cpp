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

Result<void> MapCache::share(const std::string& from, const std::string& to) const {
    if (!contains(from))
        return fail(ErrorCode::Unreadable, "there is no such map", pathOf(from).string(),
                    "Bake it again.");
    return writeAtomically(pathOf(to), [&](const std::filesystem::path& temporary) {
        std::error_code error;
        std::filesystem::remove(temporary, error);
        std::filesystem::create_hard_link(pathOf(from), temporary, error);
        if (error) {  // not every disk can
            std::filesystem::copy_file(pathOf(from), temporary,
                                       std::filesystem::copy_options::overwrite_existing, error);
        }
        if (error)
            return Result<void>(fail(ErrorCode::WriteFailed, error.message(), pathOf(to).string(),
                                     "Check the free space and the permissions of the folder."));
        return Result<void>();
    });
}

}  // namespace reflet
