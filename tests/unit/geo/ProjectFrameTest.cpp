// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/ProjectFrame.h"

#include <gtest/gtest.h>

#include <GeographicLib/UTMUPS.hpp>

namespace reflet {
namespace {

constexpr double kDegree = kPi / 180.0;

TEST(ProjectFrame, TheOriginIsAWholeKilometreAtHeightZero) {
    EXPECT_EQ(frameOrigin({85321.7, 446499.9, 12.3}), glm::dvec3(85000, 446000, 0));
    EXPECT_EQ(frameOrigin({-1500.1, 499.9, -7}), glm::dvec3(-2000, 0, 0));
}

TEST(ProjectFrame, TheGeoPositionAgreesWithGeographicLibInConvergenceToo) {
    for (const double longitude : {6.1, 8.0, 9.0, 11.9})
        for (const double latitude : {1.0, 30.0, 48.1, 70.0}) {
            int zone = 0;
            bool north = false;
            double x = 0.0;
            double y = 0.0;
            double convergence = 0.0;
            double scale = 0.0;
            GeographicLib::UTMUPS::Forward(latitude, longitude, zone, north, x, y, convergence,
                                           scale, 32);
            ProjectFrame frame;
            frame.crs = "EPSG:32632";
            frame.origin = frameOrigin({x, y, 0});
            const auto position = geoPosition(frame, glm::dvec3(x, y, 5) - frame.origin);
            ASSERT_TRUE(position) << position.error().message();
            EXPECT_NEAR(position->longitude, longitude * kDegree, 1e-12);
            EXPECT_NEAR(position->latitude, latitude * kDegree, 1e-12);
            EXPECT_NEAR(position->convergence, convergence * kDegree, 1e-7)
                << longitude << " " << latitude;
        }
}

// 1 km of grid east misses the local east by 22 m in Berlin and by 33.5 m in Munich.
TEST(ProjectFrame, TheConvergenceIsNegativeWestOfTheCentralMeridianAndPositiveEastOfIt) {
    ProjectFrame berlin;
    berlin.crs = "EPSG:25833";
    berlin.origin = {389000, 5820000, 0};
    EXPECT_NEAR(geoPosition(berlin, glm::dvec3(0.0))->convergence / kDegree, -1.27, 0.06);
    ProjectFrame munich;
    munich.crs = "EPSG:25832";
    munich.origin = {691000, 5334000, 0};
    EXPECT_NEAR(geoPosition(munich, glm::dvec3(0.0))->convergence / kDegree, 1.92, 0.01);
}

TEST(ProjectFrame, TheGeoPositionWorksInFeetAndAcrossADatum) {
    ProjectFrame newYork;
    newYork.crs = "EPSG:2263";
    newYork.origin = {980000, 200000, 0};
    const auto position = geoPosition(newYork, glm::dvec3(0.0));
    ASSERT_TRUE(position) << position.error().message();
    EXPECT_NEAR(position->longitude / kDegree, -74.0153, 1e-3);
    EXPECT_NEAR(position->latitude / kDegree, 40.7156, 1e-3);
    // The cone of Lambert turns with n = sin of the standard parallel, central meridian 74 W.
    EXPECT_NEAR(position->convergence / kDegree, (-74.0153 + 74.0) * 0.6543, 1e-3);
    ProjectFrame delft;
    delft.crs = "EPSG:28992";
    delft.origin = {85000, 446000, 0};
    EXPECT_NEAR(geoPosition(delft, {0, 500, 0})->latitude / kDegree, 52.00245561, 1e-6);
}

TEST(ProjectFrame, ALocalGeographicOrUnknownFrameHasNoGeoPosition) {
    for (const std::optional<std::string>& crs :
         {std::optional<std::string>(), std::optional<std::string>("EPSG:4326"),
          std::optional<std::string>("EPSG:999999")}) {
        ProjectFrame frame;
        frame.crs = crs;
        const auto position = geoPosition(frame, glm::dvec3(0.0));
        ASSERT_FALSE(position);
        EXPECT_EQ(position.error().code, ErrorCode::Refused);
        EXPECT_FALSE(position.error().remedy.empty());
    }
}

}  // namespace
}  // namespace reflet
