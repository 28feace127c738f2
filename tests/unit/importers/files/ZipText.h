// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>
#include <zlib.h>

namespace reflet::test {

/// Writes ZIP archives byte by byte after PKWARE's APPNOTE, so that they may also lie.
class ZipText {
public:
    struct Entry {
        std::string name, bytes;
        bool deflate = true;
        std::uint16_t flags = 0x0800;  ///< names are UTF-8; 1 = encrypted
        std::uint32_t mode = 0100644;  ///< of Unix, with the type of the file
        std::int64_t saidSize = -1;    ///< unpacked, as the archive says; -1 = as it is
        bool wrongCheck = false;       ///< its checksum does not fit
    };

    ZipText& add(std::string name, std::string bytes) {
        Entry entry;
        entry.name = std::move(name);
        entry.bytes = std::move(bytes);
        return add(std::move(entry));
    }
    ZipText& add(Entry entry) {
        m_entries.push_back(std::move(entry));
        return *this;
    }

    [[nodiscard]] std::string text() const {
        std::string out, directory;
        for (const Entry& entry : m_entries) {
            const std::string packed = entry.deflate ? deflated(entry.bytes) : entry.bytes;
            const auto* raw = reinterpret_cast<const Bytef*>(entry.bytes.data());
            const auto check = std::uint32_t(::crc32(0, raw, uInt(entry.bytes.size()))) ^
                               (entry.wrongCheck ? 1U : 0U);
            const auto size = std::uint32_t(entry.saidSize < 0 ? std::int64_t(entry.bytes.size())
                                                               : entry.saidSize);
            std::string common;
            put16(common, entry.flags);
            put16(common, entry.deflate ? 8 : 0);
            put32(common, 0x5a21'0000);  // date and time
            put32(common, check);
            put32(common, std::uint32_t(packed.size()));
            put32(common, size);
            put16(common, std::uint16_t(entry.name.size()));
            put16(common, 0);  // extra field
            const auto offset = std::uint32_t(out.size());
            out += "PK\x03\x04";
            put16(out, 20);
            out += common + entry.name + packed;
            directory += "PK\x01\x02";
            put16(directory, 0x0314);  // made on Unix
            put16(directory, 20);
            directory += common;
            put16(directory, 0);  // comment
            put16(directory, 0);  // disk
            put16(directory, 0);
            put32(directory, entry.mode << 16);
            put32(directory, offset);
            directory += entry.name;
        }
        const auto start = std::uint32_t(out.size());
        out += directory + "PK\x05\x06";
        put32(out, 0);
        put16(out, std::uint16_t(m_entries.size()));
        put16(out, std::uint16_t(m_entries.size()));
        put32(out, std::uint32_t(directory.size()));
        put32(out, start);
        put16(out, 0);
        return out;
    }

private:
    static void put16(std::string& out, std::uint32_t value) {
        out += char(value & 0xff);
        out += char((value >> 8) & 0xff);
    }
    static void put32(std::string& out, std::uint32_t value) {
        put16(out, value & 0xffff);
        put16(out, value >> 16);
    }
    static std::string deflated(const std::string& text) {
        z_stream stream{};
        deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
        std::string bytes(deflateBound(&stream, text.size()) + 64, '\0');
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
        stream.avail_in = uInt(text.size());
        stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
        stream.avail_out = uInt(bytes.size());
        deflate(&stream, Z_FINISH);
        bytes.resize(stream.total_out);
        deflateEnd(&stream);
        return bytes;
    }

    std::vector<Entry> m_entries;
};

}  // namespace reflet::test
