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
