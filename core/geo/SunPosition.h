// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/geo/ProjectFrame.h"

#include <string>
#include <string_view>

namespace reflet {

/// A civil date and time with its offset from UTC, as written in ISO 8601.
struct DateTime {
    int year = 2026, month = 5, day = 15;
    int hour = 10, minute = 0;
    double second = 0.0;
    double utcOffsetHours = 2.0;

    friend bool operator==(const DateTime&, const DateTime&) = default;
};

/// Reads "2026-05-15T10:00+02:00" ("Z" and no seconds allowed). Without an offset, the offset is
/// `defaultUtcOffsetHours`. Usage error when the text is no valid date.
[[nodiscard]] Result<DateTime> parseDateTime(std::string_view text, double defaultUtcOffsetHours);
[[nodiscard]] std::string toIso8601(const DateTime& time);

/// The offset of mean solar time rounded to whole hours: the default zone where none is given.
[[nodiscard]] double solarUtcOffsetHours(double longitude);

/// Where the sun stands: azimuth clockwise from true north, elevation above the horizon with
/// refraction, both in radians. Error below 0.02 degrees for 1950 to 2050 (Michalsky 1988 /
/// NREL-type low-precision solar coordinates; refraction after Saemundson 1986).
struct SunPosition {
    double azimuth = 0.0;
    double elevation = 0.0;
};
[[nodiscard]] SunPosition sunPosition(const DateTime& time, double longitude, double latitude);

/// Unit vector towards the sun in the project frame (true north turned into grid north).
[[nodiscard]] glm::dvec3 sunDirection(const SunPosition& sun, double gridConvergence);

}  // namespace reflet
