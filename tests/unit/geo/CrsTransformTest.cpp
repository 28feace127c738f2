// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/Crs.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace reflet {
namespace {

CrsTransform transformOrDie(const char* from, const char* to) {
    const auto source = Crs::parse(from);
    const auto target = Crs::parse(to);
    if (!source || !target)
        throw std::runtime_error("bad test");
    auto transform = CrsTransform::create(*source, *target);
    if (!transform)
        throw std::runtime_error(transform.error().message());
    return std::move(*transform);
}

glm::dvec3 moved(const char* from, const char* to, const glm::dvec3& point) {
    const auto result = transformOrDie(from, to).apply(point);
    if (!result)
        throw std::runtime_error(result.error().message());
    return *result;
}

/// Metres between two (longitude, latitude) in degrees.
double metresBetween(const glm::dvec3& a, const glm::dvec3& b) {
    double distance = 0.0;
    GeographicLib::Geodesic::WGS84().Inverse(a.y, a.x, b.y, b.x, distance);
    return distance;
}

// Reference point of the Dutch grid: its definition is RD (155000, 463000); ETRS89 after the
// Kadaster, 52 09 22.178 N, 5 23 15.500 E on Bessel. The seven-parameter shift is good to 0.25 m.
TEST(CrsTransform, PlacesTheReferencePointOfTheDutchGrid) {
    const glm::dvec3 at = moved("EPSG:28992", "EPSG:4258", {155000, 463000, 10});
    EXPECT_LT(metresBetween(at, {5.387203657, 52.155172897, 0}), 0.5);
    EXPECT_EQ(at.z, 10.0);
}

// Values of city-models' measurements: what the ballpark operation misses by 109 m.
TEST(CrsTransform, PlacesADutchCompoundSystemWithoutTheBallparkError) {
    const glm::dvec3 at = moved("EPSG:7415", "EPSG:4979", {85000, 446500, 10});
    EXPECT_LT(metresBetween(at, {4.36778561, 52.00245561, 0}), 0.05);
    EXPECT_EQ(at.z, 10.0);
}

// swisstopo, "Formulas and constants for the calculation of the Swiss conformal cylindrical
// projection": the fundamental point at Bern is E 2600000, N 1200000, and in WGS 84
// 46 57 03.898 N, 7 26 19.077 E.
TEST(CrsTransform, PlacesTheOldObservatoryOfBern) {
    const glm::dvec3 at = moved("EPSG:2056", "EPSG:4326", {2600000, 1200000, 550});
    EXPECT_LT(metresBetween(at, {7 + 26 / 60.0 + 19.077 / 3600, 46 + 57 / 60.0 + 3.898 / 3600, 0}),
              1.0);
}

// EPSG:31256 and EPSG:3879 put north first in their definition; here east always comes first.
TEST(CrsTransform, PutsEastFirstWhereTheDefinitionPutsNorthFirst) {
    const glm::dvec3 vienna = moved("EPSG:31256", "EPSG:4326", {2500, 340000, 170});
    EXPECT_NEAR(vienna.x, 16.366, 1e-3);
    EXPECT_NEAR(vienna.y, 48.198, 1e-3);
    const glm::dvec3 helsinki = moved("EPSG:3879", "EPSG:4326", {25496700, 6673000, 5});
    EXPECT_NEAR(helsinki.x, 24.94056, 1e-5);
    EXPECT_NEAR(helsinki.y, 60.16987, 1e-5);
    const glm::dvec3 warsaw = moved("EPSG:4326", "EPSG:2180", {21.0, 52.2, 0});
    EXPECT_NEAR(warsaw.x, 636700.0, 1000.0);
    EXPECT_NEAR(warsaw.y, 484000.0, 2000.0);
}

TEST(CrsTransform, AgreesWithGeographicLibOnUtm) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> longitude(6.0, 12.0);
    std::uniform_real_distribution<double> latitude(1.0, 83.0);
    const CrsTransform utm = transformOrDie("EPSG:4326", "EPSG:32632");
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 1000; ++i)
        points.emplace_back(longitude(random), latitude(random), i);
    const std::vector<glm::dvec3> source = points;
    ASSERT_TRUE(utm.apply(points));
    for (std::size_t i = 0; i < points.size(); ++i) {
        int zone = 0;
        bool north = false;
        double x = 0.0;
        double y = 0.0;
        GeographicLib::UTMUPS::Forward(source[i].y, source[i].x, zone, north, x, y, 32);
        EXPECT_NEAR(points[i].x, x, 1e-5);
        EXPECT_NEAR(points[i].y, y, 1e-5);
        EXPECT_EQ(points[i].z, double(i));
    }
}

TEST(CrsTransform, TakesGeocentricCoordinatesWithTheirHeight) {
    GeographicLib::Geocentric earth = GeographicLib::Geocentric::WGS84();
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    earth.Forward(50.8, 5.9, 123.0, x, y, z);
    const glm::dvec3 at = moved("EPSG:4978", "EPSG:4326", {x, y, z});
    EXPECT_NEAR(at.x, 5.9, 1e-9);
    EXPECT_NEAR(at.y, 50.8, 1e-9);
    EXPECT_NEAR(at.z, 123.0, 1e-6);
    const auto back = CrsTransform::create(*Crs::parse("EPSG:4326"), *Crs::parse("EPSG:4978"));
    ASSERT_FALSE(back);
    EXPECT_EQ(back.error().code, ErrorCode::Refused);
}

TEST(CrsTransform, LeavesPointsOfTheSameSystemBitByBitAsTheyAre) {
    const glm::dvec3 point(85123.456789, 446512.123456, 7.891);
    EXPECT_EQ(moved("EPSG:7415", "EPSG:28992", point), point);
    EXPECT_EQ(moved("EPSG:25832+7837", "EPSG:25832+5783", point), point);
}

TEST(CrsTransform, TransformsJapaneseDegreesToMetresOfTheSameDatumExactly) {
    const CrsTransform transform = transformOrDie("EPSG:6697", "EPSG:6677");
    const auto there = transform.apply(glm::dvec3(139.71, 35.67, 41.0));
    ASSERT_TRUE(there);
    // Zone IX: origin 36 N, 139 50 E; a geodesic on GRS 80 gives the distance to the scale's 1e-4.
    const double distance = metresBetween({139.71, 35.67, 0}, {139 + 5 / 6.0, 36.0, 0});
    EXPECT_NEAR(std::hypot(there->x, there->y), distance, 2e-4 * distance);
    EXPECT_LT(there->x, 0.0);
    EXPECT_LT(there->y, 0.0);
    EXPECT_EQ(there->z, 41.0);
}

TEST(CrsTransform, RefusesASystemWhoseDatumIsTiedToNothing) {
    const auto unknown = Crs::parse(
        "PROJCRS[\"site\",BASEGEOGCRS[\"unknown\",DATUM[\"Unknown based on a surveyor's word\","
        "ELLIPSOID[\"own\",6377000,298]]],CONVERSION[\"tm\",METHOD[\"Transverse Mercator\"],"
        "PARAMETER[\"Longitude of natural origin\",9],PARAMETER[\"Scale factor at natural origin\","
        "1],PARAMETER[\"False easting\",0],PARAMETER[\"False northing\",0],PARAMETER[\"Latitude of "
        "natural origin\",0]],CS[Cartesian,2],AXIS[\"x\",east],AXIS[\"y\",north],LENGTHUNIT["
        "\"metre\",1]]");
    ASSERT_TRUE(unknown) << unknown.error().message();
    const auto transform = CrsTransform::create(*unknown, *Crs::parse("EPSG:25832"));
    ASSERT_FALSE(transform) << transform->operationName();
    EXPECT_EQ(transform.error().code, ErrorCode::Refused);
    EXPECT_NE(transform.error().message().find("no exact transformation"), std::string::npos);
    EXPECT_FALSE(transform.error().remedy.empty());
}

TEST(CrsTransform, RefusesPointsWithoutAnImage) {
    const CrsTransform transform = transformOrDie("EPSG:25832", "EPSG:4326");
    for (const glm::dvec3& point :
         {glm::dvec3(1e9, 1e9, 0), glm::dvec3(HUGE_VAL, 0, 0), glm::dvec3(0, std::nan(""), 0)}) {
        const auto result = transform.apply(point);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::Refused);
    }
}

TEST(CrsTransform, LeavesAllPointsAsTheyWereWhenOneHasNoImage) {
    const CrsTransform transform = transformOrDie("EPSG:25832", "EPSG:4326");
    std::vector<glm::dvec3> points{{691000, 5334000, 1}, {1e9, 1e9, 2}, {692000, 5335000, 3}};
    const std::vector<glm::dvec3> before = points;
    const auto result = transform.apply(points);
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().what.find("1000000000"), std::string::npos) << result.error().what;
    EXPECT_EQ(points, before);
}

TEST(CrsTransform, TransformsNothingOutOfNoPoints) {
    std::vector<glm::dvec3> none;
    EXPECT_TRUE(transformOrDie("EPSG:28992", "EPSG:25831").apply(none));
}

TEST(CrsTransform, NamesTheOperationThatItUsedAndItsAccuracy) {
    const CrsTransform transform = transformOrDie("EPSG:28992", "EPSG:25831");
    EXPECT_NE(transform.operationName().find("Amersfoort to ETRS89"), std::string::npos)
        << transform.operationName();
    EXPECT_GT(transform.accuracy(), 0.0);
    EXPECT_LE(transform.accuracy(), 1.0);
    EXPECT_EQ(transformOrDie("EPSG:28992", "EPSG:28992").accuracy(), 0.0);
}

TEST(CrsTransform, WorksInAnotherThreadThanTheOneThatMadeIt) {
    CrsTransform transform = transformOrDie("EPSG:4326", "EPSG:32632");
    glm::dvec3 there(0.0);
    std::thread([&, mine = std::move(transform)] {
        there = mine.apply(glm::dvec3(9.0, 50.0, 0.0)).value();
    }).join();
    EXPECT_NEAR(there.x, 500000.0, 1e-6);
}

}  // namespace
}  // namespace reflet
