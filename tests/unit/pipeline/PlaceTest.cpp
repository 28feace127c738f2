// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Import.h"
#include "app/pipeline/Place.h"
#include "app/pipeline/PreparedCity.h"
#include "core/geo/LocalNorth.h"
#include "core/project/ProjectFile.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

constexpr double kDegree = kPi / 180.0;

/// A house without a CRS: 10 m along x, 20 m along y from the model's zero, 6 m high.
constexpr const char* kHouse =
    R"({"type":"CityJSON","version":"1.0","CityObjects":{"house":{"type":"Building","geometry":[)"
    R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]]]}]}},)"
    R"("vertices":[[0,0,0],[10,0,0],[10,20,0],[0,20,0],[0,0,6],[10,0,6],[10,20,6],[0,20,6]]})";

class Place : public testing::Test {
protected:
    Project imported(const std::vector<PlaceRequest>& places = {}, const std::string& crs = {}) {
        ImportRequest request;
        request.files = {folder.write("house.city.json", kHouse)};
        request.output = folder / "house.reflet";
        request.places = places;
        request.projectCrs = crs;
        const auto report = importProject(request, {});
        EXPECT_TRUE(report) << report.error().message();
        return report ? report->project : Project{};
    }
    Project placed(const Project& project, const std::string& text, const std::string& crs = {}) {
        auto request = parsePlace(text);
        EXPECT_TRUE(request) << request.error().message();
        request->crs = crs;
        auto done = placeModel(project, *request, folder.path(), {});
        EXPECT_TRUE(done) << done.error().message();
        remarks = done ? done->remarks : std::vector<Diagnostic>{};
        return done ? std::move(done->project) : Project{};
    }
    /// Where a vertex of the house (x, y) at its base stands, absolute.
    glm::dvec3 corner(const Project& project, int number) {
        auto bare = project;
        bare.generatedGround = false;
        const auto city = loadCity(bare, folder.path(), {});
        EXPECT_TRUE(city) << city.error().message();
        return city->city.frame.origin + glm::dvec3(city->city.vertices.at(std::size_t(number)));
    }

    test::TemporaryFolder folder;
    std::vector<Diagnostic> remarks;
};

TEST_F(Place, ByHandMovesAndTurnsClockwiseFromNorth) {
    const Project project = placed(imported(), "offset:100,200,5,90");
    EXPECT_FALSE(project.frame.crs);
    const glm::dvec3 zero = corner(project, 0);
    const glm::dvec3 north = corner(project, 3);  // (0, 20) of the model
    EXPECT_NEAR(glm::length(zero - glm::dvec3(100, 200, 5)), 0.0, 1e-4);
    EXPECT_NEAR(glm::length(north - glm::dvec3(120, 200, 5)), 0.0, 1e-4) << "its north looks east";
}

TEST_F(Place, ByTwoPointsBringsBothWhereTheyBelong) {
    const glm::dvec2 a(389'123.25, 5'820'456.5);
    const double turn = 30.0 * kDegree;
    const glm::dvec2 b = a + 20.0 * glm::dvec2(std::sin(turn), std::cos(turn));
    const Project project =
        placed(imported(),
               "points:0,0," + std::to_string(a.x) + "," + std::to_string(a.y) + ",0,20," +
                   std::to_string(b.x) + "," + std::to_string(b.y) + ",34",
               "EPSG:25833");
    EXPECT_TRUE(remarks.empty());
    EXPECT_EQ(project.frame.crs, "EPSG:25833");
    EXPECT_EQ(project.frame.origin, glm::dvec3(389'000, 5'820'000, 0)) << "near the house";
    EXPECT_NEAR(glm::length(corner(project, 0) - glm::dvec3(a, 34.0)), 0.0, 1e-3);
    EXPECT_NEAR(glm::length(corner(project, 3) - glm::dvec3(b, 34.0)), 0.0, 1e-3);
}

TEST_F(Place, PointsThatAreTooFarApartAreToldAndNotScaled) {
    const Project project = placed(imported(), "points:0,0,0,0,0,20,0,21");
    ASSERT_EQ(remarks.size(), 1U);
    EXPECT_EQ(remarks.front().code, "place-distance");
    EXPECT_NEAR(corner(project, 0).y, 0.5, 1e-4);
    EXPECT_NEAR(corner(project, 3).y, 20.5, 1e-4);
    EXPECT_FALSE(placeModel(imported(), *parsePlace("points:0,0,5,5,0,0,9,9"), folder.path(), {}));
}

// Berlin: grid north of UTM 33 points 1.27 degrees west of true north.
TEST_F(Place, ByLongitudeAndLatitudeItsNorthIsTheTrueOne) {
    const Project project = placed(imported(), "lonlat:13.377,52.516,0,35");
    ASSERT_EQ(project.frame.crs, "EPSG:32633");
    const auto north = localNorth("EPSG:32633", 13.377, 52.516);
    ASSERT_TRUE(north);
    ASSERT_NEAR(north->convergence / kDegree, -1.29, 0.03);
    const glm::dvec3 zero = corner(project, 0);
    EXPECT_NEAR(zero.x, north->grid.x, 1e-3);
    EXPECT_NEAR(zero.y, north->grid.y, 1e-3);
    EXPECT_NEAR(zero.z, 35.0, 1e-4);
    const glm::dvec3 along = corner(project, 3) - zero;
    // True north lies clockwise of grid north by 1.29 degrees: its point stands further east.
    EXPECT_NEAR(std::atan2(along.x, along.y), -north->convergence, 1e-5);
    EXPECT_NEAR(glm::length(along), 20.0 * north->scale, 1e-4);
}

TEST_F(Place, TheSunOfNoonStandsSouthOfWhatWasPlacedByTrueNorth) {
    Project project = placed(imported(), "lonlat:13.377,52.516,0");
    project.date = {2026, 3, 20, 12, 0, 0.0, 1.0};
    bool known = false;
    const glm::dvec3 middle = corner(project, 0) - project.frame.origin;
    // The equation of time and the longitude: the sun is due south at 12:13:57 UTC+1, +-1 min.
    project.date.minute = 13;
    project.date.second = 57.0;
    const glm::dvec3 sun = lightingOf(project, middle, known).sunDirection;
    EXPECT_TRUE(known);
    const glm::dvec3 north = corner(project, 3) - corner(project, 0);
    const double between = std::atan2(sun.x, sun.y) - std::atan2(-north.x, -north.y);
    EXPECT_NEAR(std::remainder(between, 2.0 * kPi) / kDegree, 0.0, 0.5);
    EXPECT_GT(std::abs(std::atan2(north.x, north.y)) / kDegree, 1.2) << "the grid is turned";
}

TEST_F(Place, AllThatStandsInALocalProjectMovesAlong) {
    Project project = imported();
    project.probes.push_back({"p1", {0.0, 20.0, 2.0}, std::nullopt, false});
    project.routes.push_back({"r", "r", {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}}, 0.0});
    project.views.push_back({"v", "", {10.0, 20.0, 1.6}, {0.0, 0.0, 1.6}, 0.9, 0.0});
    const Project moved = placed(project, "lonlat:13.377,52.516,40,35");
    EXPECT_NEAR(glm::length(moved.probes[0].position - corner(moved, 3) - glm::dvec3(0, 0, 2)), 0.0,
                1e-3);
    EXPECT_NEAR(glm::length(moved.routes[0].points[1] - corner(moved, 1)), 0.0, 1e-3);
    EXPECT_NEAR(glm::length(moved.views[0].position - corner(moved, 2) - glm::dvec3(0, 0, 1.6)),
                0.0, 1e-3);
    const auto city = PreparedCity::prepare(moved, folder / "house.reflet", {});
    ASSERT_TRUE(city) << city.error().message();
    for (const Diagnostic& remark : city->remarks())
        EXPECT_NE(remark.code, "place-unknown");
}

TEST_F(Place, PlacingOnceMoreTakesThePlaceOfTheFirst) {
    const Project once = placed(imported(), "lonlat:13.377,52.516,40,35");
    const Project twice = placed(once, "offset:389000,5820000,7");
    EXPECT_NEAR(glm::length(corner(twice, 0) - glm::dvec3(389'000, 5'820'000, 7)), 0.0, 1e-3);
    EXPECT_EQ(twice.frame.crs, "EPSG:32633");
}

TEST_F(Place, ImportPlacesAtOnce) {
    const Project direct = imported({*parsePlace("lonlat:13.377,52.516,40,35")});
    const Project later = placed(imported(), "lonlat:13.377,52.516,40,35");
    EXPECT_EQ(direct.frame, later.frame);
    EXPECT_EQ(direct.models, later.models);
    EXPECT_EQ(direct.date.utcOffsetHours, 1.0) << "the zone is that of the place";
}

TEST_F(Place, AModelWithAPlaceOfItsOwnCanOnlyBeMoved) {
    std::string text = kHouse;
    text.insert(text.find("\"CityObjects\""), R"("metadata":{"referenceSystem":"EPSG:25833"},)");
    ImportRequest request;
    request.files = {folder.write("berlin.city.json", text)};
    request.output = folder / "berlin.reflet";
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    const Project project = placed(report->project, "offset:0,0,43.2");
    EXPECT_NEAR(corner(project, 0).z, 43.2, 1e-4);
    EXPECT_NEAR(corner(project, 3).y, 20.0, 1e-4);
    for (const char* how : {"offset:0,0,0,10", "lonlat:13,52", "points:0,0,1,1,5,5,6,6"}) {
        const auto refused = placeModel(report->project, *parsePlace(how), folder.path(), {});
        ASSERT_FALSE(refused) << how;
        EXPECT_EQ(refused.error().code, ErrorCode::Refused);
    }
}

TEST_F(Place, WhatIsNotUnderstoodIsSaid) {
    for (const char* text : {"", "offset", "offset:", "offset:1", "offset:1,2,3,4,5", "lonlat:1,x",
                             "points:1,2,3,4", "turn:1,2", "offset:1,nan", "lonlat:1,2,"}) {
        const auto request = parsePlace(text);
        ASSERT_FALSE(request) << text;
        EXPECT_EQ(request.error().code, ErrorCode::Usage);
    }
    const auto named = parsePlace("tiles/a=b.tif=offset:1,2");
    ASSERT_TRUE(named);
    EXPECT_EQ(named->model, "tiles/a=b.tif");
    EXPECT_EQ(placeModel(imported(), *named, folder.path(), {}).error().code, ErrorCode::Usage);
    EXPECT_EQ(placeModel(imported(), *parsePlace("lonlat:13,95"), folder.path(), {}).error().code,
              ErrorCode::Usage);
}

}  // namespace
}  // namespace reflet
