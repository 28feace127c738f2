// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/environment/EnvironmentMap.h"

#include <filesystem>
#include <optional>
#include <string>

namespace reflet {

/// The folder beside a project that keeps baked maps by the hash of what they depend on. Safe to
/// delete at any time, safe when two processes write it: files are renamed into place whole, and a
/// file that cannot be read counts as absent.
class MapCache {
public:
    explicit MapCache(std::filesystem::path folder) : m_folder(std::move(folder)) {}

    /// The map stored under `key` (a ContentHash), if it is there and sound.
    [[nodiscard]] std::optional<ReferenceEnvironmentMap> find(const std::string& key) const;
    [[nodiscard]] bool contains(const std::string& key) const;
    [[nodiscard]] Result<void> store(const std::string& key,
                                     const ReferenceEnvironmentMap& map) const;
    /// Gives the map stored under `from` a second key. Unreadable when there is none.
    [[nodiscard]] Result<void> share(const std::string& from, const std::string& to) const;
    /// Size of the stored file in bytes, 0 when absent.
    [[nodiscard]] std::size_t bytes(const std::string& key) const;
    [[nodiscard]] std::filesystem::path pathOf(const std::string& key) const;

private:
    std::filesystem::path m_folder;
};

}  // namespace reflet
