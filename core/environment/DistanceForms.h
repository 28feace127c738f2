// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

// The bits of core/environment/DistanceBlocks.

namespace reflet::distance_forms {

enum class Form : unsigned { Plane = 0, Shared = 1, Listed = 2, Rough = 3 };

inline constexpr unsigned kSkyIndex = 3;  ///< of a texel in `shared`
inline constexpr int kReach = 16;         ///< of references: -kReach to kReach - 1 blocks
inline constexpr unsigned kEntryBits = 20;
inline constexpr int kSharedEntries = 2;
inline constexpr int kListedEntries = 4;

/// 1/z = a (1 + k x + l y), per metre; x and y in texels from the middle of a block.
struct Plane {
    float a = 0.0f, k = 0.0f, l = 0.0f;

    [[nodiscard]] float at(float x, float y) const { return a * (1.0f + (k * x + l * y)); }
};

/// A plane that is told from the middle of another block.
struct Reference {
    int columns = 0, rows = 0;  ///< after this block
    unsigned entry = 0;
};

/// Bits first .. first + count - 1; count below 32.
[[nodiscard]] inline unsigned bitsOf(std::uint64_t word, unsigned first, unsigned count) {
    return unsigned(word >> first) & ((1U << count) - 1U);
}
[[nodiscard]] inline int signedBitsOf(std::uint64_t word, unsigned first, unsigned count) {
    const int bits = int(bitsOf(word, first, count));
    const int sign = 1 << (count - 1U);
    return (bits ^ sign) - sign;
}

[[nodiscard]] inline Form formOf(std::uint64_t block) {
    return Form(bitsOf(block, 0, 2));
}
[[nodiscard]] inline unsigned entryOf(std::uint64_t block) {
    return bitsOf(block, 12, kEntryBits);
}
[[nodiscard]] inline std::uint64_t blockBits(Form form, unsigned entry) {
    return std::uint64_t(form) | (std::uint64_t(entry) << 12U);
}

[[nodiscard]] inline Reference referenceOf(std::uint64_t word, unsigned first) {
    return {signedBitsOf(word, first, 5), signedBitsOf(word, first + 5U, 5),
            bitsOf(word, first + 10U, kEntryBits)};
}
[[nodiscard]] inline std::uint64_t referenceBits(const Reference& reference) {
    return std::uint64_t(reference.columns & 31) | (std::uint64_t(reference.rows & 31) << 5U) |
           (std::uint64_t(reference.entry) << 10U);
}

/// Floats of 5 bits of exponent and `mantissa` of mantissa. Zero is zero; others are rounded and
/// brought into the range, which begins at 2^-20.
[[nodiscard]] std::uint64_t smallFloat(float value, unsigned mantissa);
[[nodiscard]] float fromSmallFloat(unsigned bits, unsigned mantissa);
inline constexpr unsigned kListedMantissa = 11;

/// An entry that holds a plane.
[[nodiscard]] std::uint64_t planeEntry(const Plane& plane);
[[nodiscard]] Plane planeOf(std::uint64_t entry);
/// A block of form `rough`, its form included.
[[nodiscard]] std::uint64_t roughBlock(const Plane& plane);
[[nodiscard]] Plane roughPlaneOf(std::uint64_t block);

}  // namespace reflet::distance_forms
