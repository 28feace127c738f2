// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/Crs.h"
#include "core/geo/LocalNorth.h"
#include "core/geo/ProjectFrame.h"

#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <map>
#include <string>

namespace reflet {
namespace {

constexpr double kDegree = kPi / 180.0;

TEST(LocalNorth, AgreesWithTheClosedFormsOfUtmInPlaceConvergenceAndScale) {
    for (const double longitude : {6.2, 9.0, 11.8}) {
        for (const double latitude : {-33.0, 2.0, 48.1, 70.0}) {
            int zone = 0;
            bool north = false;
            double x = 0.0;
            double y = 0.0;
            double convergence = 0.0;
            double scale = 0.0;
            GeographicLib::UTMUPS::Forward(latitude, longitude, zone, north, x, y, convergence,
                                           scale, 32);
            const auto local =
                localNorth(latitude > 0.0 ? "EPSG:32632" : "EPSG:32732", longitude, latitude);
            ASSERT_TRUE(local) << local.error().message();
            EXPECT_NEAR(local->grid.x, x, 1e-3);
            EXPECT_NEAR(local->grid.y, y, 1e-3);
            EXPECT_NEAR(local->convergence, convergence * kDegree, 1e-7);
            EXPECT_NEAR(local->scale, scale, 1e-7);
        }
    }
}

TEST(LocalNorth, IsTheSameTurnAsThatOfTheSunsNorth) {
    for (const char* crs : {"EPSG:25833", "EPSG:28992", "EPSG:2056", "EPSG:6677", "EPSG:3007"}) {
        const auto grid = Crs::parse(crs);
        const auto back = CrsTransform::create(*grid, *Crs::parse("EPSG:4326"));
        ASSERT_TRUE(grid && back) << crs;
        // A place in each grid that is not on its central meridian.
        const std::map<std::string, glm::dvec3> places{{"EPSG:25833", {389000, 5820000, 0}},
                                                       {"EPSG:28992", {85000, 446500, 0}},
                                                       {"EPSG:2056", {2683000, 1247000, 0}},
                                                       {"EPSG:6677", {-12000, -36000, 0}},
                                                       {"EPSG:3007", {147800, 6398600, 0}}};
        const glm::dvec3 place = places.at(crs);
        const auto degrees = back->apply(place);
        ASSERT_TRUE(degrees);
        const auto local = localNorth(crs, degrees->x, degrees->y);
        ASSERT_TRUE(local) << local.error().message();
        ProjectFrame frame;
        frame.crs = crs;
        const auto sun = geoPosition(frame, place);
        ASSERT_TRUE(sun);
        EXPECT_NEAR(local->convergence, sun->convergence, 1e-7) << crs;
        EXPECT_NEAR(local->grid.x, place.x, 0.01) << crs;
        EXPECT_NEAR(local->scale, 1.0, 5e-4) << crs;
    }
}

TEST(LocalNorth, RefusesWhatIsNoPlaceAndNoGridInMetres) {
    EXPECT_EQ(localNorth("EPSG:25832", 9.0, 91.0).error().code, ErrorCode::Usage);
    EXPECT_EQ(localNorth("EPSG:25832", 999.0, 48.0).error().code, ErrorCode::Usage);
    EXPECT_EQ(localNorth("EPSG:4326", 9.0, 48.0).error().code, ErrorCode::Refused);
    EXPECT_EQ(localNorth("EPSG:2263", -74.0, 40.7).error().code, ErrorCode::Refused);
    EXPECT_FALSE(localNorth("nonsense", 9.0, 48.0));
}

TEST(LocalNorth, NamesTheUtmZoneWithTheExceptionsOfTheNorth) {
    EXPECT_EQ(*utmZone(13.4, 52.5), "EPSG:32633");
    EXPECT_EQ(*utmZone(-70.6, -33.4), "EPSG:32719");
    EXPECT_EQ(*utmZone(5.3, 60.4), "EPSG:32632") << "Bergen";
    EXPECT_EQ(*utmZone(15.6, 78.2), "EPSG:32633") << "Longyearbyen";
    EXPECT_EQ(*utmZone(-180.0, 10.0), "EPSG:32601");
    EXPECT_EQ(utmZone(10.0, 88.0).error().code, ErrorCode::Usage);
}

// ---- PROJ against sources that do not use it ----

glm::dvec3 transformed(const char* from, const char* to, const glm::dvec3& point) {
    const auto operation = CrsTransform::create(*Crs::parse(from), *Crs::parse(to));
    EXPECT_TRUE(operation) << from;
    const auto image = operation ? operation->apply(point) : Result<glm::dvec3>(glm::dvec3(0.0));
    EXPECT_TRUE(image) << image.error().message();
    return image.value_or(glm::dvec3(0.0));
}

/// A transverse Mercator projection by GeographicLib: Krüger's series, not PROJ's code.
glm::dvec2 transverseMercator(double a, double f, double scale, const glm::dvec2& centre,
                              const glm::dvec2& place) {
    const GeographicLib::TransverseMercator projection(a, f, scale);
    double x0 = 0.0;
    double y0 = 0.0;
    glm::dvec2 out(0.0);
    projection.Forward(centre.x, centre.y, centre.x, x0, y0);
    projection.Forward(centre.x, place.y, place.x, out.x, out.y);
    return {out.x, out.y - y0};
}

constexpr double kGrs80Radius = 6378137.0;
constexpr double kGrs80Flattening = 1.0 / 298.257222101;

TEST(PlacesOnTheEarth, GermanUtmWithHeightsAgreesWithinAMillimetre) {
    for (const glm::dvec2 place : {glm::dvec2(11.57, 48.14), {6.96, 50.94}, {9.99, 53.55}}) {
        const glm::dvec2 truth =
            transverseMercator(kGrs80Radius, kGrs80Flattening, 0.9996, {9.0, 0.0}, place) +
            glm::dvec2(500'000.0, 0.0);
        const glm::dvec3 own =
            transformed("EPSG:4258", "EPSG:25832+7837", {place.x, place.y, 519.0});
        EXPECT_NEAR(own.x, truth.x, 1e-3);
        EXPECT_NEAR(own.y, truth.y, 1e-3);
        EXPECT_EQ(own.z, 519.0) << "heights keep their datum";
    }
}

TEST(PlacesOnTheEarth, JapaneseDegreesAgreeWithinAMillimetre) {
    for (const glm::dvec2 place : {glm::dvec2(139.71, 35.67), {139.65, 35.28}}) {
        const glm::dvec2 truth = transverseMercator(kGrs80Radius, kGrs80Flattening, 0.9999,
                                                    {139.0 + 50.0 / 60.0, 36.0}, place);
        const glm::dvec3 own = transformed("EPSG:6697", "EPSG:6677", {place.x, place.y, 3.0});
        EXPECT_NEAR(own.x, truth.x, 1e-3);
        EXPECT_NEAR(own.y, truth.y, 1e-3);
    }
}

// The example in swisstopo's "Approximate formulas for the transformation between Swiss projection
// coordinates and WGS84": 46 2' 38.87" N, 8 43' 49.79" E is 700 000 / 100 000 m in LV03.
TEST(PlacesOnTheEarth, TheSwissExampleAgreesWithinAMetre) {
    const glm::dvec3 degrees(8.0 + 43.0 / 60.0 + 49.79 / 3600.0, 46.0 + 2.0 / 60.0 + 38.87 / 3600.0,
                             0.0);
    const glm::dvec3 own = transformed("EPSG:4326", "EPSG:2056", degrees);
    EXPECT_NEAR(own.x, 2'700'000.0, 1.0);
    EXPECT_NEAR(own.y, 1'100'000.0, 1.0);
}

// Schreutelkamp and Strang van Hees (2001), "Benaderingsformules voor de transformatie tussen RD-
// en WGS84-kaartcoordinaten": 155 000 / 463 000 m is 52.15517440 N, 5.38720621 E, within a metre.
TEST(PlacesOnTheEarth, TheDutchOriginAgreesWithinAMetre) {
    const glm::dvec3 own = transformed("EPSG:7415", "EPSG:4326", {155'000.0, 463'000.0, 10.0});
    const GeographicLib::LocalCartesian plane(52.15517440, 5.38720621, 0.0);
    double east = 0.0;
    double north = 0.0;
    double up = 0.0;
    plane.Forward(own.y, own.x, 0.0, east, north, up);
    EXPECT_NEAR(east, 0.0, 1.0);
    EXPECT_NEAR(north, 0.0, 1.0);
    EXPECT_EQ(own.z, 10.0);
}

}  // namespace
}  // namespace reflet
