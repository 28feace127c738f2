// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/extrusion/Lengths.h"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

namespace reflet::extrusion {

namespace {

constexpr double kFoot = 0.3048;
constexpr double kInch = 0.0254;
constexpr double kHighest = 2000.0;  // metres

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Takes a number from the front of the text, with a point or a comma; nullopt when there is none.
std::optional<double> takeNumber(std::string_view& text) {
    std::string number(text.substr(0, text.find_first_not_of("+-.,0123456789eE")));
    if (const auto comma = number.find(','); comma != std::string::npos)
        number[comma] = '.';
    const char* const begin = number.data() + (number.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = std::from_chars(begin, number.data() + number.size(), value);
    if (error != std::errc() || !std::isfinite(value))
        return std::nullopt;
    text.remove_prefix(std::size_t(end - number.data()));
    return value;
}

/// What follows the feet of "7'4\"".
std::optional<double> inches(std::string_view rest) {
    rest = trimmed(rest);
    if (rest.empty())
        return 0.0;
    const auto value = takeNumber(rest);
    const std::string_view unit = trimmed(rest);
    const bool known = unit == "\"" || unit == "in" || unit == "''" || unit.empty();
    return value && known ? std::optional(*value * kInch) : std::nullopt;
}

std::optional<double> unitOf(std::string_view name, double plain) {
    if (name.empty())
        return plain;
    if (name == "m" || name == "M" || name == "metres" || name == "meters" || name == "metre" ||
        name == "meter")
        return 1.0;
    if (name == "ft" || name == "feet" || name == "foot")
        return kFoot;
    if (name == "cm")
        return 0.01;
    if (name == "km")
        return 1000.0;
    return std::nullopt;
}

}  // namespace

std::optional<double> parseLength(std::string_view text, double unit) {
    text = trimmed(text);
    if (text.starts_with('~'))
        text = trimmed(text.substr(1));
    const auto value = takeNumber(text);
    if (!value)
        return std::nullopt;
    text = trimmed(text);
    double metres = 0.0;
    if (text.starts_with('\'')) {
        const auto rest = inches(text.substr(1));
        if (!rest)
            return std::nullopt;
        metres = *value * kFoot + *rest;
    } else {
        const auto factor = unitOf(text, unit);
        if (!factor)
            return std::nullopt;
        metres = *value * *factor;
    }
    return std::abs(metres) <= kHighest ? std::optional(metres) : std::nullopt;
}

std::optional<double> parseStoreys(std::string_view text) {
    constexpr double kMost = 300.0;
    text = trimmed(text);
    const auto value = takeNumber(text);
    const bool sound = value && trimmed(text).empty() && *value >= 0.0 && *value <= kMost;
    return sound ? value : std::nullopt;
}

}  // namespace reflet::extrusion
