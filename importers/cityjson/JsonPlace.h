// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace reflet::cityjson {

/// "line 3, column 11" of a byte of a text.
[[nodiscard]] std::string placeOf(std::string_view text, std::size_t offset);

/// Why a text is no JSON and where, for people: "line 3, column 11: unexpected string". Empty when
/// the text is valid. Walks the whole text once; nesting costs one bit a level.
[[nodiscard]] std::string whyNotJson(std::string_view text);

}  // namespace reflet::cityjson
