// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/Utf8Reader.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <span>
#include <string_view>

namespace reflet::citygml {

namespace {

void appendUtf8(std::string& text, std::uint32_t code) {
    const auto put = [&](std::uint32_t bits) { text += static_cast<char>(bits); };
    if (code < 0x80) {
        put(code);
    } else if (code < 0x800) {
        put(0xc0 | (code >> 6));
        put(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        put(0xe0 | (code >> 12));
        put(0x80 | ((code >> 6) & 0x3f));
        put(0x80 | (code & 0x3f));
    } else {
        put(0xf0 | (code >> 18));
        put(0x80 | ((code >> 12) & 0x3f));
        put(0x80 | ((code >> 6) & 0x3f));
        put(0x80 | (code & 0x3f));
    }
}

/// The name in encoding="..." of the declaration, in upper case; empty when there is none.
std::string declaredEncoding(std::string_view start) {
    const std::size_t end = start.find("?>");
    if (!start.starts_with("<?xml") || end == std::string_view::npos)
        return {};
    const std::string_view declaration = start.substr(0, end);
    const std::size_t key = declaration.find("encoding");
    const std::size_t open = declaration.find_first_of("\"'", key);
    if (key == std::string_view::npos || open == std::string_view::npos)
        return {};
    const std::size_t close = declaration.find(declaration[open], open + 1);
    std::string name(declaration.substr(open + 1, close - open - 1));
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return name;
}

}  // namespace

Result<void> Utf8Reader::recognise() {
    const std::string_view start = m_bytes;
    const auto is = [&](std::string_view mark) { return start.starts_with(mark); };
    if (is("\xef\xbb\xbf")) {
        m_encoding = Encoding::Utf8;
        m_bytes.erase(0, 3);
    } else if (is("\xff\xfe") || is(std::string_view("<\0", 2))) {
        m_encoding = Encoding::Utf16Little;
        m_bytes.erase(0, is("<") ? 0 : 2);
    } else if (is("\xfe\xff") || is(std::string_view("\0<", 2))) {
        m_encoding = Encoding::Utf16Big;
        m_bytes.erase(0, is("\xfe") ? 2 : 0);
    } else {
        const std::string name = declaredEncoding(start);
        if (name.empty() || name == "UTF-8" || name == "UTF8" || name == "US-ASCII")
            m_encoding = Encoding::Utf8;
        else if (name == "ISO-8859-1" || name == "LATIN1" || name == "LATIN-1" ||
                 name == "ISO-8859-15" || name == "WINDOWS-1252" || name == "CP1252")
            m_encoding = Encoding::Latin1;  // they differ in a few signs, in names only
        else
            return fail(
                ErrorCode::Unreadable,
                "is written in the encoding \"" + name.substr(0, 40) + "\", which is not known", {},
                "Save it as UTF-8.");
    }
    return {};
}

void Utf8Reader::decodeUtf16(bool bigEndian, std::string& text) {
    const auto unit = [&](std::size_t at) {
        const auto first = static_cast<unsigned char>(m_bytes[at]);
        const auto second = static_cast<unsigned char>(m_bytes[at + 1]);
        return bigEndian ? first * 256U + second : second * 256U + first;
    };
    constexpr std::uint32_t kReplacement = 0xfffd;
    std::size_t at = 0;
    while (at + 1 < m_bytes.size()) {
        const std::uint32_t code = unit(at);
        const bool high = code >= 0xd800 && code < 0xdc00;
        if (high && at + 3 >= m_bytes.size() && !m_atEnd)
            break;  // its other half is in the next block
        const std::uint32_t low = high && at + 3 < m_bytes.size() ? unit(at + 2) : 0;
        if (high && low >= 0xdc00 && low < 0xe000) {
            appendUtf8(text, 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00));
            at += 4;
        } else {
            appendUtf8(text, code >= 0xd800 && code < 0xe000 ? kReplacement : code);
            at += 2;
        }
    }
    m_bytes.erase(0, at);
}

void Utf8Reader::decodeLatin1(std::string& text) {
    for (const char c : m_bytes)
        appendUtf8(text, static_cast<unsigned char>(c));
    m_bytes.clear();
}

Result<bool> Utf8Reader::appendTo(std::string& text) {
    constexpr std::size_t kBlock = std::size_t(1) << 20;
    if (m_atEnd)
        return false;
    const std::size_t kept = m_bytes.size();
    m_bytes.resize(kept + kBlock);
    const auto count = m_source.read(std::span(m_bytes).subspan(kept));
    if (!count)
        return tl::unexpected<Error>(count.error());
    m_bytes.resize(kept + *count);
    m_position += *count;
    m_atEnd = *count < kBlock;
    if (m_encoding == Encoding::Unknown) {
        if (auto known = recognise(); !known)
            return tl::unexpected<Error>(known.error());
    }
    if (m_encoding == Encoding::Utf8) {
        text += m_bytes;
        m_bytes.clear();
    } else if (m_encoding == Encoding::Latin1) {
        decodeLatin1(text);
    } else {
        decodeUtf16(m_encoding == Encoding::Utf16Big, text);
    }
    return true;
}

}  // namespace reflet::citygml
