// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/SunPosition.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>

namespace reflet {

namespace {

/// Reads the parts of an ISO 8601 text one after the other; each fails by returning false.
class Reader {
public:
    explicit Reader(std::string_view text) : m_rest(text) {}

    [[nodiscard]] bool atEnd() const { return m_rest.empty(); }
    bool accept(std::string_view anyOf) {
        if (m_rest.empty() || anyOf.find(m_rest.front()) == std::string_view::npos)
            return false;
        m_taken = m_rest.front();
        m_rest.remove_prefix(1);
        return true;
    }
    /// The character that the last accept() took.
    [[nodiscard]] char taken() const { return m_taken; }
    bool number(std::size_t digits, int& value) {
        if (m_rest.size() < digits)
            return false;
        value = 0;
        for (const char c : m_rest.substr(0, digits)) {
            if (c < '0' || c > '9')
                return false;
            value = 10 * value + (c - '0');
        }
        m_rest.remove_prefix(digits);
        return true;
    }
    /// The digits after a decimal point, at least one.
    bool fraction(double& value) {
        double place = 0.1;
        const std::size_t before = m_rest.size();
        while (!m_rest.empty() && m_rest.front() >= '0' && m_rest.front() <= '9') {
            value += place * (m_rest.front() - '0');
            place *= 0.1;
            m_rest.remove_prefix(1);
        }
        return m_rest.size() != before;
    }

private:
    std::string_view m_rest;
    char m_taken = '\0';
};

bool readDate(Reader& in, DateTime& time) {
    return in.number(4, time.year) && in.accept("-") && in.number(2, time.month) &&
           in.accept("-") && in.number(2, time.day);
}

bool readClock(Reader& in, DateTime& time) {
    if (!in.accept("Tt ") || !in.number(2, time.hour) || !in.accept(":") ||
        !in.number(2, time.minute))
        return false;
    time.second = 0.0;
    if (!in.accept(":"))
        return true;
    int seconds = 0;
    if (!in.number(2, seconds))
        return false;
    time.second = seconds;
    return !in.accept(".,") || in.fraction(time.second);
}

bool readOffset(Reader& in, DateTime& time) {
    if (in.atEnd())
        return true;
    if (in.accept("Zz")) {
        time.utcOffsetHours = 0.0;
        return true;
    }
    if (!in.accept("+-"))
        return false;
    const double sign = in.taken() == '-' ? -1.0 : 1.0;
    int hours = 0;
    int minutes = 0;
    if (!in.number(2, hours))
        return false;
    if (in.accept(":") || !in.atEnd()) {
        if (!in.number(2, minutes))
            return false;
    }
    time.utcOffsetHours = sign * (hours + minutes / 60.0);
    return minutes < 60;
}

bool isReal(const DateTime& time) {
    const std::chrono::year_month_day date{std::chrono::year(time.year),
                                           std::chrono::month(unsigned(time.month)),
                                           std::chrono::day(unsigned(time.day))};
    constexpr double kWidestZone = 14.0;  // Line Islands
    return date.ok() && time.hour < 24 && time.minute < 60 && time.second < 60.0 &&
           std::abs(time.utcOffsetHours) <= kWidestZone;
}

}  // namespace

Result<DateTime> parseDateTime(std::string_view text, double defaultUtcOffsetHours) {
    DateTime time;
    time.utcOffsetHours = defaultUtcOffsetHours;
    Reader in(text);
    if (readDate(in, time) && readClock(in, time) && readOffset(in, time) && in.atEnd() &&
        isReal(time))
        return time;
    return fail(ErrorCode::Usage, "no valid date and time", std::string(text.substr(0, 60)),
                "Write it like 2026-05-15T10:00+02:00.");
}

std::string toIso8601(const DateTime& time) {
    std::string text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:", time.year, time.month,
                                   time.day, time.hour, time.minute);
    // Milliseconds, cut and not rounded, so that 59.9999 s does not become 60.
    const int milliseconds = int(std::floor(time.second * 1000.0 + 1e-6));
    text += fmt::format("{:02}", milliseconds / 1000);
    if (milliseconds % 1000 != 0)
        text += fmt::format(".{:03}", milliseconds % 1000);
    const int minutes = int(std::lround(time.utcOffsetHours * 60.0));
    if (minutes == 0)
        return text + "Z";
    return text + fmt::format("{}{:02}:{:02}", minutes < 0 ? '-' : '+', std::abs(minutes) / 60,
                              std::abs(minutes) % 60);
}

double solarUtcOffsetHours(double longitude) {
    return std::round(longitude * 12.0 / kPi) + 0.0;  // no negative zero
}

}  // namespace reflet
