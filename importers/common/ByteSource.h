// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/base/JobContext.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace reflet::importers {

/// Bytes that are read from their start to their end.
class ByteSource {
public:
    virtual ~ByteSource() = default;
    /// Fills `into` as far as there is something; the number of bytes is smaller only at the end.
    [[nodiscard]] virtual Result<std::size_t> read(std::span<char> into) = 0;
    /// The same bytes, from their start.
    [[nodiscard]] virtual Result<std::unique_ptr<ByteSource>> again() const = 0;
    [[nodiscard]] virtual std::size_t size() const = 0;
};

/// The bytes of a file, or, of a gzip file, those that are packed in it. Unreadable as by
/// readFile(); ResourceLimit above `limit` bytes.
[[nodiscard]] Result<std::unique_ptr<ByteSource>> openFile(const std::filesystem::path& path,
                                                           std::size_t limit);
/// All of them at once.
[[nodiscard]] Result<std::string> readAll(ByteSource& source, const JobContext& job = {});
/// Bytes that outlive the source.
[[nodiscard]] std::unique_ptr<ByteSource> openBytes(std::string_view bytes);

}  // namespace reflet::importers
