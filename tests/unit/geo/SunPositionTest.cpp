// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/SunPosition.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

constexpr double kDegree = kPi / 180.0;

SunPosition sunAt(const char* time, double longitude, double latitude) {
    return sunPosition(parseDateTime(time, 0.0).value(), longitude * kDegree, latitude * kDegree);
}

double hoursAt(int minutes) {
    return minutes / 60.0;
}

/// The minute of the day, in UTC, at which the upper limb rises or sets: for almanacs when the
/// centre is 50 minutes of arc below the horizon without refraction, which Saemundson's formula
/// lifts by 37.1 there.
int crossingMinute(int year, int month, int day, double longitude, double latitude, bool rising,
                   int firstMinute, int lastMinute) {
    const double horizon = (37.1 - 50.0) / 60.0 * kDegree;
    for (int minute = firstMinute; minute <= lastMinute; ++minute) {
        const DateTime time{year, month, day, minute / 60, minute % 60, 0.0, 0.0};
        const double e = sunPosition(time, longitude * kDegree, latitude * kDegree).elevation;
        if (rising == (e >= horizon))
            return minute;
    }
    return -1;
}

// Reda and Andreas 2008, "Solar position algorithm for solar radiation applications",
// NREL/TP-560-34302, table A5.1: zenith 50.11162, azimuth 194.34024 degrees.
TEST(SunPosition, AgreesWithTheExampleOfNrelsAlgorithm) {
    const SunPosition sun = sunAt("2003-10-17T12:30:30-07:00", -105.1786, 39.742476);
    EXPECT_NEAR(90.0 - sun.elevation / kDegree, 50.11162, 0.02);
    EXPECT_NEAR(sun.azimuth / kDegree, 194.34024, 0.02);
}

// Meeus, Astronomical Algorithms, example 25.a: 1992 October 13.0 TD, right ascension 198.38083,
// declination -7.78507 degrees. Where the local sidereal time is that right ascension, the sun
// stands in the meridian.
TEST(SunPosition, AgreesWithTheExampleOfMeeus) {
    const double siderealTime = 280.46062 + 360.98564737 * (2448908.5 - 2451545.0);
    const double longitude = std::remainder(198.38083 - siderealTime, 360.0);
    const SunPosition sun = sunAt("1992-10-13T00:00Z", longitude, -60.0);
    EXPECT_NEAR(std::remainder(sun.azimuth / kDegree, 360.0), 0.0, 0.02);  // due north of it
    const double expected = 90.0 - (60.0 - 7.78507);
    EXPECT_NEAR(sun.elevation / kDegree, expected + 0.0213, 0.02);  // refraction at 37.8 degrees
}

TEST(SunPosition, StandsOverTheTropicsAtTheSolstices) {
    // 2026-06-21 08:24 UTC: the sun's declination is the obliquity, 23.436 degrees.
    double highest = 0.0;
    for (int minute = 0; minute < 24 * 60; ++minute) {
        const DateTime time{2026, 6, 21, minute / 60, minute % 60, 0.0, 0.0};
        highest = std::max(highest, sunPosition(time, 0.0, 50.0 * kDegree).elevation);
    }
    EXPECT_NEAR(highest / kDegree, 90.0 - 50.0 + 23.436, 0.03);
}

TEST(SunPosition, IsOnTheEquatorAndRisesDueEastAtAnEquinox) {
    // Equinox 2026-03-20 14:46 UTC (almanac). At the equator the sun then rises due east.
    const SunPosition sun = sunAt("2026-03-20T14:46Z", -130.0, 0.0);
    EXPECT_NEAR(sun.azimuth / kDegree, 90.0, 0.05);
    EXPECT_GT(sun.elevation, 0.0);
}

// Sunrise and sunset of almanacs, in UTC, to the minute.
TEST(SunPosition, RisesAndSetsWhenAlmanacsSay) {
    // Greenwich (51.48 N, 0 E), 2024-06-20: sunrise 03:43, sunset 20:21.
    EXPECT_NEAR(crossingMinute(2024, 6, 20, 0.0, 51.48, true, 120, 400), 3 * 60 + 43, 1);
    EXPECT_NEAR(crossingMinute(2024, 6, 20, 0.0, 51.48, false, 1000, 1439), 20 * 60 + 21, 1);
    // Greenwich, 2024-12-21: sunrise 08:03, sunset 15:53.
    EXPECT_NEAR(crossingMinute(2024, 12, 21, 0.0, 51.48, true, 300, 700), 8 * 60 + 3, 1);
    EXPECT_NEAR(crossingMinute(2024, 12, 21, 0.0, 51.48, false, 800, 1200), 15 * 60 + 53, 1);
}

TEST(SunPosition, NeverRisesInThePolarNightAndNeverSetsOnThePolarDay) {
    for (int minute = 0; minute < 24 * 60; minute += 10) {
        const DateTime winter{2026, 12, 21, minute / 60, minute % 60, 0.0, 0.0};
        const DateTime summer{2026, 6, 21, minute / 60, minute % 60, 0.0, 0.0};
        EXPECT_LT(sunPosition(winter, 0.3, 75.0 * kDegree).elevation, 0.0) << hoursAt(minute);
        EXPECT_GT(sunPosition(summer, 0.3, 75.0 * kDegree).elevation, 0.0) << hoursAt(minute);
    }
}

TEST(SunPosition, IsFarBelowTheHorizonAtMidnight) {
    const SunPosition sun = sunAt("2026-03-20T00:07Z", 0.0, 40.0);
    EXPECT_NEAR(sun.elevation / kDegree, -50.0, 0.5);
}

TEST(SunPosition, DependsOnTheInstantAndNotOnTheZoneItIsWrittenIn) {
    const SunPosition a = sunAt("2026-05-15T10:00+02:00", 4.36, 52.0);
    const SunPosition b = sunAt("2026-05-15T08:00Z", 4.36, 52.0);
    const SunPosition c = sunAt("2026-05-14T22:00-10:00", 4.36, 52.0);
    EXPECT_NEAR(a.azimuth, b.azimuth, 1e-9);
    EXPECT_NEAR(a.elevation, c.elevation, 1e-9);
}

TEST(SunPosition, MovesSteadilyThroughTheHorizonInSpiteOfTheRefraction) {
    double before = -10.0;
    for (int second = 0; second < 3600 * 3; second += 5) {
        const DateTime time{2026, 3, 20, 5 + second / 3600, second / 60 % 60, double(second % 60),
                            0.0};
        const double elevation = sunPosition(time, 0.0, 0.7).elevation;
        EXPECT_GT(elevation, before);
        EXPECT_TRUE(before < -9.0 || elevation - before < 0.001);
        before = elevation;
    }
}

TEST(SunPosition, TheDirectionPointsEastNorthAndUp) {
    const glm::dvec3 north = sunDirection({0.0, 0.0}, 0.0);
    EXPECT_NEAR(glm::distance(north, {0, 1, 0}), 0.0, 1e-15);
    const glm::dvec3 east = sunDirection({0.5 * kPi, 0.0}, 0.0);
    EXPECT_NEAR(glm::distance(east, {1, 0, 0}), 0.0, 1e-15);
    const glm::dvec3 up = sunDirection({1.0, 0.5 * kPi}, 0.2);
    EXPECT_NEAR(glm::distance(up, {0, 0, 1}), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(sunDirection({4.0, 0.6}, -0.03)), 1.0, 1e-15);
}

// In Munich grid north points 1.92 degrees east of true north: a sun due north of true north
// stands 1.92 degrees west of the grid's, at negative x.
TEST(SunPosition, TheDirectionTurnsTrueNorthIntoGridNorth) {
    const double convergence = 1.92 * kDegree;
    const glm::dvec3 trueNorth = sunDirection({0.0, 0.0}, convergence);
    EXPECT_NEAR(trueNorth.x, -std::sin(convergence), 1e-15);
    EXPECT_NEAR(trueNorth.y, std::cos(convergence), 1e-15);
}

}  // namespace
}  // namespace reflet
