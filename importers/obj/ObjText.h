// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

// The words and numbers of lines of OBJ and MTL files.
namespace reflet::obj {

inline constexpr std::string_view kBlanks = " \t\r\v\f";

inline std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Takes the next word from the front of a line; empty at its end.
inline std::string_view nextWord(std::string_view& line) {
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) {
        line = {};
        return {};
    }
    const std::size_t end = std::min(line.find_first_of(kBlanks, first), line.size());
    const std::string_view word = line.substr(first, end - first);
    line.remove_prefix(end);
    return word;
}

/// NaN for what is no number.
inline double numberOf(std::string_view word) {
    if (word.starts_with('+'))
        word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = error == std::errc() && end == word.data() + word.size();
    return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

inline double nextNumber(std::string_view& line) {
    return numberOf(nextWord(line));
}

}  // namespace reflet::obj
