// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"
#include "core/traffic/Route.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

const Route kRightAngle({{0, 0, 1}, {30, 0, 1}, {30, 40, 5}});

TEST(Route, MeasuresLengthInThePlan) {
    EXPECT_DOUBLE_EQ(kRightAngle.length(), 70.0);
    EXPECT_DOUBLE_EQ(Route({{0, 0, 0}, {3, 4, 100}}).length(), 5.0);
}

TEST(Route, InterpolatesPositionAndHeightAlongTheLegs) {
    const glm::dvec3 p = kRightAngle.at(50.0);
    EXPECT_NEAR(p.x, 30.0, 1e-12);
    EXPECT_NEAR(p.y, 20.0, 1e-12);
    EXPECT_NEAR(p.z, 3.0, 1e-12);
}

TEST(Route, ClampsToItsEnds) {
    EXPECT_EQ(kRightAngle.at(-7.0), glm::dvec3(0, 0, 1));
    EXPECT_EQ(kRightAngle.at(1e9), glm::dvec3(30, 40, 5));
    EXPECT_EQ(kRightAngle.tangent(-1.0), glm::dvec3(1, 0, 0));
    EXPECT_EQ(kRightAngle.tangent(1e9), glm::dvec3(0, 1, 0));
}

TEST(Route, DropsRepeatedPointsAndPointsAboveOneAnother) {
    const Route route({{0, 0, 0}, {0, 0, 0}, {10, 0, 0}, {10, 0, 3}, {20, 0, 0}});
    EXPECT_EQ(route.points().size(), 3U);
    EXPECT_DOUBLE_EQ(route.length(), 20.0);
    for (double s = 0.0; s <= 20.0; s += 0.25) {
        EXPECT_TRUE(std::isfinite(glm::length(route.at(s)) + glm::length(route.tangent(s))));
    }
}

TEST(RouteDeathTest, RefusesPointsThatAreAllTheSame) {
    EXPECT_DEATH(Route({{1, 2, 3}, {1, 2, 3}}), "two distinct points");
}

TEST(Route, SpacesStationsEvenlyFromEndToEnd) {
    const std::vector<double> stations = kRightAngle.stations(15.0);
    ASSERT_EQ(stations.size(), 6U);  // 70 / 15 -> five steps of 14
    for (std::size_t i = 0; i < stations.size(); ++i) {
        EXPECT_NEAR(stations[i], 14.0 * double(i), 1e-12);
    }
    EXPECT_EQ(kRightAngle.stations(70.0).size(), 2U);
    EXPECT_EQ(kRightAngle.stations(1000.0).size(), 2U);
}

TEST(Route, RoundsARightAngleWithTheArcOfItsRadius) {
    const Route smooth = kRightAngle.smoothed(10.0);
    // Two tangents of 10 m each are replaced by a quarter of a circle around (20, 10).
    EXPECT_NEAR(smooth.length(), 70.0 - 20.0 + 5.0 * kPi, 0.02);
    int onArc = 0;
    for (const glm::dvec3& p : smooth.points()) {
        if (p.x > 20.0 + 1e-9 && p.y < 10.0 - 1e-9) {
            EXPECT_NEAR(std::hypot(p.x - 20.0, p.y - 10.0), 10.0, 1e-9);
            ++onArc;
        }
    }
    EXPECT_GE(onArc, 20);
    EXPECT_EQ(smooth.at(0.0), kRightAngle.at(0.0));
    EXPECT_EQ(smooth.at(smooth.length()), kRightAngle.at(70.0));
}

TEST(Route, SamplesASmoothedRouteEveryHalfMetre) {
    const std::vector<glm::dvec3> points = kRightAngle.smoothed(10.0).points();
    ASSERT_GT(points.size(), 100U);
    for (std::size_t i = 1; i < points.size(); ++i) {
        EXPECT_LE(std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y),
                  0.5 + 1e-9);
    }
}

TEST(Route, KeepsTheTangentContinuousThroughARoundedCorner) {
    const Route smooth = kRightAngle.smoothed(10.0);
    for (double s = 0.0; s + 0.1 <= smooth.length(); s += 0.1) {
        // At most the turn of one chord: 0.5 m on a radius of 10 m.
        EXPECT_GT(glm::dot(smooth.tangent(s), smooth.tangent(s + 0.1)), std::cos(0.06));
    }
}

TEST(Route, ShortensARadiusThatDoesNotFitBetweenTwoCorners) {
    const Route smooth = Route({{0, 0, 0}, {50, 0, 0}, {50, 6, 0}, {100, 6, 0}}).smoothed(20.0);
    // The corners share a leg of 6 m: each arc has a radius of 3 m.
    EXPECT_NEAR(smooth.length(), 106.0 - 12.0 + 2.0 * 0.5 * kPi * 3.0, 0.1);
    for (const glm::dvec3& p : smooth.points()) {
        EXPECT_GE(p.y, -1e-9);
        EXPECT_LE(p.y, 6.0 + 1e-9);
    }
}

TEST(Route, LeavesStraightCornersAndReversalsWhereTheyAre) {
    EXPECT_NEAR(Route({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}).smoothed(5.0).length(), 20.0, 1e-9);
    EXPECT_NEAR(Route({{0, 0, 0}, {10, 0, 0}, {0, 0, 0}}).smoothed(5.0).length(), 20.0, 1e-9);
    EXPECT_NEAR(kRightAngle.smoothed(0.0).length(), 70.0, 1e-9);
}

}  // namespace
}  // namespace reflet
