// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjsonseq/LineReader.h"

#include <span>
#include <string_view>

namespace reflet::cityjsonseq {

namespace {

constexpr std::string_view kAround = " \t\r\x1e";

std::string_view trimmed(std::string_view line) {
    if (line.starts_with("\xef\xbb\xbf"))
        line.remove_prefix(3);
    const std::size_t begin = line.find_first_not_of(kAround);
    if (begin == std::string_view::npos)
        return {};
    return line.substr(begin, line.find_last_not_of(kAround) + 1 - begin);
}

}  // namespace

/// Reads another block behind what is left. False: there is nothing more.
Result<bool> LineReader::fill() {
    constexpr std::size_t kBlock = std::size_t(1) << 20;
    constexpr std::size_t kLongestLine = std::size_t(1) << 30;
    if (m_atEnd)
        return false;
    m_buffer.erase(0, m_begin);
    m_begin = 0;
    const std::size_t kept = m_buffer.size();
    if (kept > kLongestLine)
        return fail(ErrorCode::ResourceLimit,
                    "has a line of more than 1 GiB: line " + std::to_string(m_number + 1), {},
                    "Write one feature on each line.");
    m_buffer.resize(kept + kBlock);
    const auto count = m_source.read(std::span(m_buffer).subspan(kept));
    if (!count)
        return tl::unexpected<Error>(count.error());
    m_buffer.resize(kept + *count);
    m_atEnd = *count < kBlock;
    return *count > 0;
}

Result<bool> LineReader::next(std::string& line) {
    std::size_t searched = m_begin;
    for (;;) {
        const std::size_t end = m_buffer.find('\n', searched);
        if (end == std::string::npos) {
            searched = m_buffer.size() - m_begin;
            const auto more = fill();
            if (!more)
                return tl::unexpected<Error>(more.error());
            if (*more)
                continue;
        }
        const std::size_t stop = end == std::string::npos ? m_buffer.size() : end;
        if (end == std::string::npos && stop == m_begin)
            return false;
        line = trimmed(std::string_view(m_buffer).substr(m_begin, stop - m_begin));
        const std::size_t next = end == std::string::npos ? stop : end + 1;
        m_position += next - m_begin;
        m_begin = next;
        searched = next;
        ++m_number;
        if (!line.empty())
            return true;
    }
}

}  // namespace reflet::cityjsonseq
