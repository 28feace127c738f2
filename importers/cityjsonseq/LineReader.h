// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/common/ByteSource.h"

#include <cstddef>
#include <string>

namespace reflet::cityjsonseq {

/// Splits bytes into lines, one in memory at a time. Byte order mark, record separators (RFC 8142)
/// and blanks around a line are dropped, and so are lines without anything else.
class LineReader {
public:
    explicit LineReader(importers::ByteSource& source) : m_source(source) {}

    /// The next line; false at the end. ResourceLimit for a line beyond 1 GiB.
    [[nodiscard]] Result<bool> next(std::string& line);
    /// Of the last line, counted from 1.
    [[nodiscard]] std::size_t number() const { return m_number; }
    /// Bytes up to the end of the last line.
    [[nodiscard]] std::size_t position() const { return m_position; }

private:
    [[nodiscard]] Result<bool> fill();

    importers::ByteSource& m_source;
    std::string m_buffer;
    std::size_t m_begin = 0;  ///< of what is not handed out yet
    std::size_t m_number = 0;
    std::size_t m_position = 0;
    bool m_atEnd = false;
};

}  // namespace reflet::cityjsonseq
