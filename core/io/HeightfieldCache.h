// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/heightfield/Heightfield.h"

#include <filesystem>
#include <optional>
#include <string>

namespace reflet {

/// Heightfields beside a project, by the hash of what they depend on, in the same folder and with
/// the same habits as MapCache: safe to delete at any time, renamed into place whole, and a file
/// that is damaged or of another grid counts as absent. Only the few newest are kept.
class HeightfieldCache {
public:
    explicit HeightfieldCache(std::filesystem::path folder) : m_folder(std::move(folder)) {}

    /// grid: of the heightfield that is looked for; nothing larger is ever read.
    [[nodiscard]] std::optional<Heightfield> find(const std::string& key,
                                                  const GridSpec& grid) const;
    /// Refused for layers that do not fill the grid; WriteFailed.
    [[nodiscard]] Result<void> store(const std::string& key, const Heightfield& field) const;
    [[nodiscard]] std::filesystem::path pathOf(const std::string& key) const;

private:
    void removeOld() const;

    std::filesystem::path m_folder;
};

}  // namespace reflet
