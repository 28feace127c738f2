// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/InputFile.h"
#include "importers/common/ByteSource.h"

namespace reflet::importers {

/// The first two bytes of a gzip file (RFC 1952).
[[nodiscard]] bool looksLikeGzip(std::string_view start);

/// What is in a gzip file, unpacked as it is read. Unreadable where it is damaged or cut off;
/// ResourceLimit beyond `limit` bytes. Its size() is that of the packed file.
[[nodiscard]] std::unique_ptr<ByteSource> unpackGzip(InputFile file, std::size_t limit);

}  // namespace reflet::importers
