// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/SeenSpace.h"
#include "core/base/Error.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// What was noted of a map when it was baked.
struct Sight {
    std::string map;            ///< its key in the MapCache
    SeenSpace seen;             ///< what it depends on
    std::uint64_t content = 0;  ///< what the city showed there: contentOf(seen, …)
};

/// Keeps the sights of baked maps beside them, by the hash of all that they depend on but the city:
/// the last few of each, so that a city may change there and back. Safe to delete at any time, safe
/// when two processes write it: files are renamed into place whole, and one that is not sound
/// counts as absent.
class SightCache {
public:
    explicit SightCache(std::filesystem::path folder) : m_folder(std::move(folder)) {}

    /// All that are kept under the key, the last first.
    [[nodiscard]] std::vector<Sight> find(const std::string& key) const;
    [[nodiscard]] Result<void> store(const std::string& key, const Sight& sight) const;
    [[nodiscard]] std::filesystem::path pathOf(const std::string& key,
                                               const std::string& map) const;
    static constexpr std::size_t kKept = 4;  ///< of each key

private:
    /// The files of a key, the last first.
    [[nodiscard]] std::vector<std::filesystem::path> filesOf(const std::string& key) const;

    std::filesystem::path m_folder;
};

}  // namespace reflet
