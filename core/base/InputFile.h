// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace reflet {

/// A file that is read piece by piece from its start, for what is too large to be held at once.
class InputFile {
public:
    /// Unreadable when it cannot be opened or is a directory, as by readFile().
    [[nodiscard]] static Result<InputFile> open(const std::filesystem::path& path);

    /// Fills `into` as far as the file goes; the number of bytes is smaller only at its end.
    [[nodiscard]] Result<std::size_t> read(std::span<char> into);
    /// In bytes, as it was when the file was opened.
    [[nodiscard]] std::size_t size() const { return m_size; }
    [[nodiscard]] const std::filesystem::path& path() const { return m_path; }

    InputFile(InputFile&& other) noexcept;
    InputFile& operator=(InputFile&& other) noexcept;
    ~InputFile();

private:
    InputFile(std::filesystem::path path, int descriptor, std::size_t size)
        : m_path(std::move(path)), m_descriptor(descriptor), m_size(size) {}

    std::filesystem::path m_path;
    int m_descriptor = -1;
    std::size_t m_size = 0;
};

}  // namespace reflet
