// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/Bc6h.h"

#include <array>
#include <cstdint>

// The forms of BC6H with one region (Khronos Data Format Specification 1.3, section 20.2).

namespace reflet::bc6h {

struct Form {
    unsigned code;  ///< the lowest 5 bits of the block
    int bits;       ///< of the first colour's channels
    int deltaBits;  ///< of the second's, as a signed difference; 0 = it is told outright
};
inline constexpr std::array<Form, 4> kForms{
    {{0x03, 10, 0}, {0x07, 11, 9}, {0x0b, 12, 8}, {0x0f, 16, 4}}};

/// How far along the line the steps lie, in 64ths.
inline constexpr std::array<int, 16> kSteps{0,  4,  9,  13, 17, 21, 26, 30,
                                            34, 38, 43, 47, 51, 55, 60, 64};

/// A block taken apart.
struct Parts {
    std::array<int, 3> first{}, second{};  ///< quantised colours
    std::array<std::uint8_t, 16> steps{};  ///< of the texels, 0 to 15; that of the first below 8
};

/// A quantised channel as a number of 16 bits.
[[nodiscard]] inline int widened(int value, int bits) {
    const int most = (1 << bits) - 1;
    if (bits >= 15 || value == 0)
        return value;
    return value == most ? 0xFFFF : ((value << 16) + 0x8000) >> bits;
}

/// The bit pattern of the half float on a step between two widened channels.
[[nodiscard]] inline int halfBitsAt(int first, int second, int step) {
    return ((first * (64 - step) + second * step + 32) >> 6) * 31 >> 6;
}

/// Whether a form can tell these two colours.
[[nodiscard]] bool fits(const Form& form, const Parts& parts);
[[nodiscard]] Bc6hBlock pack(const Form& form, const Parts& parts);
/// Null for forms that kForms does not hold.
[[nodiscard]] const Form* formOf(const Bc6hBlock& block);
[[nodiscard]] Parts unpack(const Form& form, const Bc6hBlock& block);

}  // namespace reflet::bc6h
