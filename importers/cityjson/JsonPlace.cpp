// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/JsonPlace.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet::cityjson {

namespace {

/// Takes every event and keeps only the first error.
struct ErrorCatcher : nlohmann::json_sax<nlohmann::json> {
    std::size_t byte = 0;
    std::string message;

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool key(string_t&) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& error) override {
        byte = position;
        message = error.what();
        return false;
    }
};

/// "[json.exception.parse_error.101] parse error at line 3, column 11: syntax error while parsing
/// object - unexpected string literal; expected '{'" -> "unexpected string literal; expected '{'"
std::string shortened(const std::string& message) {
    constexpr std::string_view kDash = " - ";
    const std::size_t dash = message.find(kDash);
    std::string reason = dash == std::string::npos ? message : message.substr(dash + kDash.size());
    constexpr std::size_t kLongest = 160;
    if (reason.size() > kLongest)
        reason = reason.substr(0, kLongest) + "...";
    // What was read may hold any byte of the file.
    for (char& c : reason) {
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e)
            c = '?';
    }
    return reason;
}

}  // namespace

std::string placeOf(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t newline = before.rfind('\n');
    const std::size_t column =
        newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
    return fmt::format("line {}, column {}", line, column);
}

std::string whyNotJson(std::string_view text) {
    ErrorCatcher catcher;
    if (nlohmann::json::sax_parse(text.begin(), text.end(), &catcher))
        return {};
    // The position counts the bytes read, the offending one included.
    const std::size_t offset = catcher.byte > 0 ? catcher.byte - 1 : 0;
    return fmt::format("{}: {}", placeOf(text, offset), shortened(catcher.message));
}

}  // namespace reflet::cityjson
