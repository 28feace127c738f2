// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace reflet {

inline constexpr int kDotColumns = 5, kDotRows = 7;
inline constexpr int kDotAdvance = 6;  ///< dots from letter to letter

/// Rows from the top; the five low bits of each are the dots, left = high bit.
using DotGlyph = std::array<std::uint8_t, kDotRows>;

/// A letter of dots, as on the displays of trams: capital letters, digits and - . , : ( ) % /.
/// Null for all else, the blank among them.
[[nodiscard]] const DotGlyph* dotGlyph(char character);

}  // namespace reflet
