// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/input/RouteSnap.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

// From 100 m straight above: 0.2 m a pixel on the ground, so that 9 pixels reach 1.8 m.
const ViewGeometry kView{{{0, 0, 100}, {0, 0, 0}, kPi / 2.0}, 1000, 1000};
const std::vector<RouteGlyph> kRoutes{
    {.id = "r", .line = {{-20, 0, 0}, {20, 0, 0}}, .handles = {{-20, 0, 0}, {20, 0, 0}}}};

TEST(RouteSnap, TakesTheNearestCornerWithinReachAndKeepsTheHeight) {
    ASSERT_NEAR(kView.metresPerPixel(100.0), 0.2, 1e-9);
    EXPECT_EQ(snappedToCorners(kRoutes, kView, {19, 1.4, 0}), glm::dvec3(20, 0, 0));
    EXPECT_EQ(snappedToCorners(kRoutes, kView, {19, 1.6, 0}), glm::dvec3(19, 1.6, 0));
    EXPECT_EQ(snappedToCorners(kRoutes, kView, {0, 0.5, 0}), glm::dvec3(0, 0.5, 0));
}

TEST(RouteSnap, TakesTheNearestPointOfALineWithinReachAndKeepsTheHeight) {
    EXPECT_EQ(snappedToLines(kRoutes, kView, {5, 1.7, 1.0}), glm::dvec3(5, 0, 1.0));
    EXPECT_EQ(snappedToLines(kRoutes, kView, {5, 1.9, 0}), glm::dvec3(5, 1.9, 0));
    EXPECT_EQ(snappedToLines(kRoutes, kView, {21, 0, 0}), glm::dvec3(20, 0, 0));
    EXPECT_EQ(snappedToLines({}, kView, {5, 1.7, 0}), glm::dvec3(5, 1.7, 0));
}

}  // namespace
}  // namespace reflet
