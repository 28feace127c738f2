// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace reflet {

/// A folder among the system's temporary ones, removed with what is in it at the end.
class ScratchFolder {
public:
    ScratchFolder() {
        std::error_code none;
        std::string name =
            (std::filesystem::temp_directory_path(none) / "reflet-bench-XXXXXX").string();
        if (::mkdtemp(name.data()) != nullptr)
            m_path = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        if (!m_path.empty())
            std::filesystem::remove_all(m_path, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return m_path; }  ///< empty: none

private:
    std::filesystem::path m_path;
};

}  // namespace reflet
