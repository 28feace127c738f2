// SPDX-License-Identifier: GPL-3.0-or-later
// Archives and folders with pictures as what a project is made of.
#include "app/pipeline/Import.h"
#include "core/project/ProjectFile.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"
#include "tests/unit/importers/CityJsonText.h"
#include "tests/unit/importers/files/ZipText.h"

#include <cstdlib>

namespace reflet {
namespace {

using namespace test;
namespace fs = std::filesystem;

json boxCity() {
    json city = emptyCity();
    city["vertices"] = boxVertices();
    city["CityObjects"]["a"] = {{"type", "Building"}, {"geometry", {solid("1")}}};
    return city;
}

/// Its floor has a picture.
json picturedCity(const std::string& image) {
    json city = boxCity();
    city["appearance"] = {{"textures", {{{"type", "PNG"}, {"image", image}}}},
                          {"vertices-texture", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
    const json none = json::array();
    city["CityObjects"]["a"]["geometry"][0]["texture"]["t"]["values"] = json::array(
        {json::array({json::array({json::array({0, 0, 1, 2, 3})}), none, none, none, none, none})});
    return city;
}

TEST(CityFilesPipeline, AnArchiveIsAModelOfTheProjectAndIsReadAgainFromIt) {
    const TemporaryFolder folder;
    ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    ImportRequest request;
    request.files = {
        folder.write("town.zip", ZipText().add("a.city.json", boxCity().dump()).text())};
    request.output = folder / "town.reflet";
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    ASSERT_EQ(report->project.models.size(), 1U);
    EXPECT_EQ(report->project.models.front().path, "town.zip");
    fs::remove_all(folder / "cache");
    auto project = loadProject(request.output);
    ASSERT_TRUE(project);
    project->generatedGround = false;
    const auto city = loadCity(*project, folder.path(), {});
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_EQ(city->city.triangles.size(), 12U);
    EXPECT_EQ(city->city.bounds().size(), glm::dvec3(10.0, 8.0, 6.0));
    EXPECT_TRUE(city->remarks.empty());
}

TEST(CityFilesPipeline, APictureThatAModelNamesIsNoOrthophoto) {
    const auto picture = sharedData("geotiff/manila-ortho.tif");
    if (!picture)
        GTEST_SKIP() << kNoSharedData;
    const TemporaryFolder folder;
    const fs::path wall = folder.write("wall.tif", bytesOf(*picture));
    ImportRequest request;
    request.files = {folder.write("a.city.json", picturedCity("wall.tif").dump()), wall};
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_EQ(report->project.models.size(), 1U);
    const auto added = addModels(report->project, {}, request.files, {});
    ASSERT_TRUE(added) << added.error().message();
    EXPECT_EQ(added->models.size(), 2U);
    // Where no model names it, it is a picture of the ground, here of another country's.
    request.files.front() = folder.write("b.city.json", boxCity().dump());
    const auto apart = importProject(request, {});
    EXPECT_TRUE(!apart || apart->project.models.size() == 2U);
}

}  // namespace
}  // namespace reflet
