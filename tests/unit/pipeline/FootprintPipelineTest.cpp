// SPDX-License-Identifier: GPL-3.0-or-later
// Footprints and OpenStreetMap data on their way into a project.
#include "app/pipeline/Import.h"
#include "app/pipeline/LoadedCity.h"
#include "core/project/ProjectFile.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace reflet {
namespace {

namespace fs = std::filesystem;

/// A slope in RD New that rises from 10 m to 20 m over 100 m towards the east.
constexpr const char* kSlope = R"({"type": "CityJSON", "version": "2.0",
  "transform": {"scale": [1, 1, 1], "translate": [85000, 446000, 0]},
  "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/28992"},
  "CityObjects": {"ground": {"type": "TINRelief", "geometry": [{"type": "CompositeSurface",
    "lod": "1", "boundaries": [[[0, 1, 2]], [[0, 2, 3]]]}]}},
  "vertices": [[0, 0, 10], [100, 0, 20], [100, 100, 20], [0, 100, 10]]})";

/// 10 m by 10 m at 50 m east; the height is in an attribute of a name of its own.
constexpr const char* kHouse = R"({"type": "FeatureCollection",
  "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::28992"}},
  "features": [{"type": "Feature", "properties": {"rise": 7}, "geometry": {"type": "Polygon",
    "coordinates": [[[85050,446040],[85060,446040],[85060,446050],[85050,446050],[85050,446040]]]
  }}]})";

class FootprintPipeline : public testing::Test {
protected:
    fs::path write(const std::string& name, const char* text) const {
        std::ofstream(folder.path() / name) << text;
        return folder.path() / name;
    }
    test::TemporaryFolder folder;
};

TEST_F(FootprintPipeline, StandsFootprintsOnTheTerrainOfAnotherFileAndRemembersTheirHeights) {
    ImportRequest request;
    request.files = {write("house.geojson", kHouse), write("slope.city.json", kSlope)};
    request.output = folder.path() / "town.reflet";
    request.heightField = "rise";
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    const auto project = loadProject(request.output);
    ASSERT_TRUE(project) << project.error().message();
    EXPECT_EQ(project->models[0].heightField, "rise");
    EXPECT_TRUE(project->models == report->project.models);
    const auto loaded = loadCity(*project, folder.path(), {});
    ASSERT_TRUE(loaded) << loaded.error().message();
    Box house;
    for (const CityTriangle& t : loaded->city.triangles) {
        if (loaded->city.objects[loaded->city.surfaces[t.surface].object].type !=
            CityObjectType::Building)
            continue;
        for (const std::uint32_t vertex : t.vertex)
            house.add(glm::dvec3(loaded->city.vertices[vertex]));
    }
    EXPECT_NEAR(house.min.z, 15.0, 1e-4);  // the slope at its western wall
    EXPECT_NEAR(house.max.z, 22.0, 1e-4);
}

/// Two trees in RD New, the second of them beside the slope.
constexpr const char* kTrees = R"({"type": "FeatureCollection",
  "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::28992"}}, "features": [
  {"type": "Feature", "properties": {"baumid": "east", "baumhoehe": 9, "kronedurch": 4},
   "geometry": {"type": "Point", "coordinates": [85080, 446050]}}]})";

Box boxOf(const CityModel& city, const std::string& id) {
    Box box;
    for (const CityTriangle& t : city.triangles) {
        if (city.objects[city.surfaces[t.surface].object].id != id)
            continue;
        for (const std::uint32_t vertex : t.vertex)
            box.add(glm::dvec3(city.vertices[vertex]));
    }
    return box;
}

TEST_F(FootprintPipeline, StandsTreesOnTheTerrainAndRemembersTheirCrowns) {
    ImportRequest request;
    request.files = {write("slope.city.json", kSlope), write("trees.geojson", kTrees)};
    request.output = folder.path() / "town.reflet";
    request.crownField = "kronedurch";
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    const auto project = loadProject(request.output);
    ASSERT_TRUE(project) << project.error().message();
    EXPECT_EQ(project->models[1].crownField, "kronedurch");
    const auto loaded = loadCity(*project, folder.path(), {});
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Box tree = boxOf(loaded->city, "east");
    // The slope is at 18 m under the trunk, 20 cm lower at the western edge of the crown.
    EXPECT_NEAR(tree.min.z, 17.8, 0.1);
    EXPECT_NEAR(tree.max.z - tree.min.z, 9.0, 1e-4);
}

TEST_F(FootprintPipeline, StandsTreesOnTheGroundThatIsGeneratedFromTheBuildings) {
    // A house whose base is 40 m above the datum, as in a city model without terrain.
    const char* const house = R"({"type": "CityJSON", "version": "2.0",
      "transform": {"scale": [1, 1, 1], "translate": [85000, 446000, 40]},
      "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/28992"},
      "CityObjects": {"house": {"type": "Building", "geometry": [{"type": "MultiSurface",
        "lod": "1", "boundaries": [[[0, 3, 2, 1]], [[0, 1, 5, 4]], [[1, 2, 6, 5]], [[2, 3, 7, 6]],
        [[3, 0, 4, 7]], [[4, 5, 6, 7]]]}]}},
      "vertices": [[0, 0, 0], [50, 0, 0], [50, 50, 0], [0, 50, 0],
                   [0, 0, 9], [50, 0, 9], [50, 50, 9], [0, 50, 9]]})";
    ImportRequest request;
    request.files = {write("house.city.json", house), write("trees.geojson", kTrees)};
    request.output = folder.path() / "town.reflet";
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_TRUE(report->city->generatedGround);
    const auto loaded = loadCity(report->project, folder.path(), {});
    ASSERT_TRUE(loaded) << loaded.error().message();
    ASSERT_TRUE(loaded->generatedGround);
    EXPECT_NEAR(boxOf(loaded->city, "east").min.z, 40.0, 0.2);
}

TEST_F(FootprintPipeline, OffersTheLongestStreetsOfOpenStreetMapAsRoutes) {
    const auto osm = test::sharedData("osm/nuernberg-laufamholz.osm");
    if (!osm)
        GTEST_SKIP() << test::kNoSharedData;
    ImportRequest request;
    request.files = {*osm};
    request.output = folder.path() / "town.reflet";
    request.routes = *osm;
    request.vehicle = "bus";
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_EQ(report->project.routes.size(), 3U);
    EXPECT_EQ(report->project.reflectors.size(), 3U);
    EXPECT_TRUE(std::any_of(report->remarks.begin(), report->remarks.end(),
                            [](const Diagnostic& d) { return d.code == "routes-chosen"; }));
}

}  // namespace
}  // namespace reflet
