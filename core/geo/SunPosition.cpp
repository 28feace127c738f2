// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/SunPosition.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace reflet {

namespace {

constexpr double kDegree = kPi / 180.0;

/// Days of universal time since 2000-01-01 12:00.
double daysSinceJ2000(const DateTime& time) {
    using namespace std::chrono;
    const sys_days date =
        year_month_day{year(time.year), month(unsigned(time.month)), day(unsigned(time.day))};
    const sys_days epoch = year_month_day{year(2000), month(1), day(1)};
    const double hours =
        time.hour + time.minute / 60.0 + time.second / 3600.0 - time.utcOffsetHours;
    return double((date - epoch).count()) + hours / 24.0 - 0.5;
}

/// Saemundson 1986 (Meeus, Astronomical Algorithms, 16.4) at 1010 hPa and 10 degrees Celsius. It
/// serves until the upper limb sets, the centre 50 minutes of arc below the horizon; further down,
/// where nobody sees the sun, the refraction fades out like 1 / tan without a step.
double refraction(double trueElevation) {
    const auto saemundson = [](double degrees) {
        return 1.02 / std::tan((degrees + 10.3 / (degrees + 5.11)) * kDegree);
    };
    constexpr double kSunset = -50.0 / 60.0;
    const double h = trueElevation / kDegree;
    const double minutes =
        h >= kSunset ? saemundson(h)
                     : saemundson(kSunset) * std::tan(kSunset * kDegree) / std::tan(trueElevation);
    return std::max(minutes, 0.0) / 60.0 * kDegree;
}

}  // namespace

// Michalsky 1988, "The Astronomical Almanac's algorithm for approximate solar position
// (1950-2050)", Solar Energy 40(3): the sun on the ecliptic to 0.01 degrees, turned into the
// equator's frame, then by the sidereal time into the observer's.
SunPosition sunPosition(const DateTime& time, double longitude, double latitude) {
    const double n = daysSinceJ2000(time);
    const double meanLongitude = 280.460 + 0.9856474 * n;
    const double anomaly = (357.528 + 0.9856003 * n) * kDegree;
    const double ecliptic =
        (meanLongitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2.0 * anomaly)) * kDegree;
    const double obliquity = (23.439 - 0.0000004 * n) * kDegree;
    const double rightAscension =
        std::atan2(std::cos(obliquity) * std::sin(ecliptic), std::cos(ecliptic));
    const double declination = std::asin(std::sin(obliquity) * std::sin(ecliptic));

    // Greenwich mean sidereal time; n is counted from noon, so the fraction of the day is in it.
    const double siderealTime = (280.46062 + 360.98564737 * n) * kDegree;
    const double hourAngle = siderealTime + longitude - rightAscension;

    const double east = -std::cos(declination) * std::sin(hourAngle);
    const double north = std::sin(declination) * std::cos(latitude) -
                         std::cos(declination) * std::cos(hourAngle) * std::sin(latitude);
    const double up = std::sin(declination) * std::sin(latitude) +
                      std::cos(declination) * std::cos(hourAngle) * std::cos(latitude);
    const double geocentric = std::atan2(up, std::hypot(east, north));
    // Seen from the surface and not from the Earth's centre: the solar parallax of 8.794 seconds.
    const double elevation = geocentric - 8.794 / 3600.0 * kDegree * std::cos(geocentric);

    double azimuth = std::atan2(east, north);
    if (azimuth < 0.0)
        azimuth += 2.0 * kPi;
    return {azimuth, std::min(elevation + refraction(elevation), 0.5 * kPi)};
}

glm::dvec3 sunDirection(const SunPosition& sun, double gridConvergence) {
    // Azimuth counts from true north; grid north stands gridConvergence clockwise from it.
    const double fromGridNorth = sun.azimuth - gridConvergence;
    const double level = std::cos(sun.elevation);
    return {level * std::sin(fromGridNorth), level * std::cos(fromGridNorth),
            std::sin(sun.elevation)};
}

}  // namespace reflet
