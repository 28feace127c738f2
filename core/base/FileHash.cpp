// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/FileHash.h"

#include "core/base/InputFile.h"

#include <span>
#include <vector>

namespace reflet {

Result<void> addFileBytes(ContentHash& hash, const std::filesystem::path& path) {
    auto file = InputFile::open(path);
    if (!file)
        return tl::unexpected(file.error());
    hash.beginBytes(file->size());
    std::vector<char> piece(std::size_t(1) << 20);
    for (;;) {
        const auto count = file->read(piece);
        if (!count)
            return tl::unexpected(count.error());
        hash.continueBytes(std::as_bytes(std::span(piece.data(), *count)));
        if (*count < piece.size())
            return {};
    }
}

}  // namespace reflet
