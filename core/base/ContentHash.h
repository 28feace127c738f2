// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace reflet {

/// Builds a 128-bit key (XXH3) from everything that a derived file depends on. Equal inputs in
/// equal order give equal keys on every little-endian machine. Not meant against attackers.
class ContentHash {
public:
    ContentHash();
    ~ContentHash();
    ContentHash(const ContentHash&) = delete;
    ContentHash& operator=(const ContentHash&) = delete;

    /// Adds a string with its length, so that "ab","c" and "a","bc" differ.
    ContentHash& add(std::string_view text);
    /// Adds raw bytes with their length.
    ContentHash& addBytes(std::span<const std::byte> bytes);
    /// The same in parts: the length of all of them, then one after the other.
    ContentHash& beginBytes(std::uint64_t size);
    ContentHash& continueBytes(std::span<const std::byte> part);
    template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T> ContentHash& add(T value) {
        return addBytes(std::as_bytes(std::span<const T, 1>(&value, 1)));
    }
    /// 32 lower-case hexadecimal digits.
    [[nodiscard]] std::string hex() const;

private:
    void* m_state;
};

}  // namespace reflet
