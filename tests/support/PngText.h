// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>
#include <zlib.h>

namespace reflet::test {

/// A PNG (RFC 2083) of 8-bit RGBA pixels, rows from the top, made without the libraries that read
/// it. The header may claim another size than there are pixels.
inline std::string png(std::uint32_t width, std::uint32_t height,
                       const std::vector<std::array<std::uint8_t, 4>>& pixels) {
    const auto word = [](std::uint32_t value) {
        std::string out;
        for (int shift = 24; shift >= 0; shift -= 8)
            out.push_back(char(value >> unsigned(shift) & 0xffU));
        return out;
    };
    const auto chunk = [&](std::string body) {
        const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
        return word(std::uint32_t(body.size() - 4)) + body + word(std::uint32_t(sum));
    };
    std::string raw;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (i % width == 0)
            raw.push_back('\0');
        for (const std::uint8_t value : pixels[i])
            raw.push_back(char(value));
    }
    uLongf size = compressBound(uLong(raw.size()));
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size,
             reinterpret_cast<const Bytef*>(raw.data()), uLong(raw.size()));
    packed.resize(size);
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR" + word(width) + word(height) + std::string("\x08\x06\0\0\0", 5)) +
           chunk("IDAT" + packed) + chunk("IEND");
}

}  // namespace reflet::test
