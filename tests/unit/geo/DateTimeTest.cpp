// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/SunPosition.h"

#include <gtest/gtest.h>

#include <string>

namespace reflet {
namespace {

TEST(DateTime, ReadsIsoTextsWithAndWithoutSecondsAndOffset) {
    EXPECT_EQ(parseDateTime("2026-05-15T10:00+02:00", 0.0).value(),
              (DateTime{2026, 5, 15, 10, 0, 0.0, 2.0}));
    EXPECT_EQ(parseDateTime("2003-10-17T12:30:30-07:00", 0.0).value(),
              (DateTime{2003, 10, 17, 12, 30, 30.0, -7.0}));
    EXPECT_EQ(parseDateTime("2024-02-29T23:59:59.5Z", 1.0).value(),
              (DateTime{2024, 2, 29, 23, 59, 59.5, 0.0}));
    EXPECT_EQ(parseDateTime("2026-12-31 00:00", 9.0).value(),
              (DateTime{2026, 12, 31, 0, 0, 0.0, 9.0}));
    EXPECT_EQ(parseDateTime("2026-01-01T00:00+0545", 0.0).value().utcOffsetHours, 5.75);
    EXPECT_EQ(parseDateTime("2026-01-01T00:00-03:30", 0.0).value().utcOffsetHours, -3.5);
    EXPECT_EQ(parseDateTime("2026-01-01T00:00+09", 0.0).value().utcOffsetHours, 9.0);
}

TEST(DateTime, RefusesWhatIsNoDateAndShowsHowToWriteOne) {
    for (const char* text : {"",
                             "2026",
                             "2026-05-15",
                             "15.05.2026 10:00",
                             "2026-13-01T10:00",
                             "2026-00-01T10:00",
                             "2026-02-29T10:00",
                             "2026-04-31T10:00",
                             "2026-05-15T24:00",
                             "2026-05-15T10:60",
                             "2026-05-15T10:00:60",
                             "2026-05-15T10:00:",
                             "2026-05-15T10:00:00.",
                             "2026-05-15T10",
                             "2026-05-15T10:00+15:00",
                             "2026-05-15T10:00+02:60",
                             "2026-05-15T10:00+2",
                             "2026-05-15T10:00+02:0",
                             "2026-05-15T10:00 CEST",
                             "2026-05-15T10:00ZZ",
                             "2026-5-15T10:00",
                             "-026-05-15T10:00",
                             "2026-05-15T1 :00"}) {
        const auto time = parseDateTime(text, 0.0);
        ASSERT_FALSE(time) << text;
        EXPECT_EQ(time.error().code, ErrorCode::Usage);
        EXPECT_EQ(time.error().subject, text);
        EXPECT_NE(time.error().remedy.find("2026-05-15T10:00+02:00"), std::string::npos);
    }
}

TEST(DateTime, WritesWhatItReads) {
    for (const char* text : {"2026-05-15T10:00:00+02:00", "2003-10-17T12:30:30-07:00",
                             "2024-02-29T23:59:59.500Z", "2026-01-01T00:00:00+05:45",
                             "2026-01-01T00:00:00-03:30", "2026-06-01T06:07:08.250+00:30"}) {
        const auto time = parseDateTime(text, 3.0);
        ASSERT_TRUE(time) << text;
        EXPECT_EQ(toIso8601(*time), text);
    }
    DateTime almost;
    almost.second = 59.9999;
    EXPECT_EQ(toIso8601(almost), "2026-05-15T10:00:59.999+02:00");
}

TEST(DateTime, TheDefaultZoneFollowsTheSun) {
    constexpr double kDegree = kPi / 180.0;
    EXPECT_EQ(solarUtcOffsetHours(0.0), 0.0);
    EXPECT_EQ(solarUtcOffsetHours(4.37 * kDegree), 0.0);
    EXPECT_EQ(solarUtcOffsetHours(13.4 * kDegree), 1.0);
    EXPECT_EQ(solarUtcOffsetHours(139.7 * kDegree), 9.0);
    EXPECT_EQ(solarUtcOffsetHours(-74.0 * kDegree), -5.0);
}

}  // namespace
}  // namespace reflet
