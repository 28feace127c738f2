// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/common/ByteSource.h"

#include <cstddef>
#include <string>

namespace reflet::citygml {

/// Hands out an XML file as UTF-8, block by block. Knows UTF-8, UTF-16 and Latin-1 by the byte
/// order mark, the first bytes and the declaration.
class Utf8Reader {
public:
    explicit Utf8Reader(importers::ByteSource& source) : m_source(source) {}

    /// Appends the next block, without byte order mark. False: there is nothing more. Unreadable
    /// for an encoding that is not known.
    [[nodiscard]] Result<bool> appendTo(std::string& text);
    /// Bytes of the file that have been read.
    [[nodiscard]] std::size_t position() const { return m_position; }

private:
    enum class Encoding { Unknown, Utf8, Utf16Little, Utf16Big, Latin1 };
    [[nodiscard]] Result<void> recognise();
    void decodeUtf16(bool bigEndian, std::string& text);
    void decodeLatin1(std::string& text);

    importers::ByteSource& m_source;
    Encoding m_encoding = Encoding::Unknown;
    std::string m_bytes;  ///< read and not decoded yet
    std::size_t m_position = 0;
    bool m_atEnd = false;
};

}  // namespace reflet::citygml
