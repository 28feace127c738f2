// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/GroundModels.h"
#include "app/pipeline/Import.h"
#include "app/pipeline/PreparedCity.h"
#include "core/project/ProjectFile.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

namespace fs = std::filesystem;

/// Four houses of 10 m by 10 m whose bases stand at `base`, in EPSG:25832 unless `crs` is empty.
std::string houses(double base, const std::string& crs = "EPSG:25832") {
    std::string objects;
    std::string vertices;
    int next = 0;
    for (int k = 0; k < 4; ++k) {
        const double x = 690'040.0 + 40.0 * k;
        const double y = 5'335'050.0;
        const int v = next;
        for (const double z : {base, base + 8.0})
            for (const glm::dvec2 p : {glm::dvec2(0, 0), {10, 0}, {10, 10}, {0, 10}}) {
                vertices += fmt::format("{}[{},{},{}]", next == 0 ? "" : ",", x + p.x, y + p.y, z);
                ++next;
            }
        objects += fmt::format(
            R"({}"h{}":{{"type":"Building","geometry":[{{"type":"MultiSurface","lod":"2",)"
            R"("boundaries":[[[{},{},{},{}]],[[{},{},{},{}]],[[{},{},{},{}]]]}}]}})",
            k == 0 ? "" : ",", k, v, v + 3, v + 2, v + 1, v + 4, v + 5, v + 6, v + 7, v, v + 1,
            v + 5, v + 4);
    }
    const std::string metadata =
        crs.empty() ? "" : R"("metadata":{"referenceSystem":")" + crs + R"("},)";
    return R"({"type":"CityJSON","version":"1.0",)" + metadata + R"("CityObjects":{)" + objects +
           R"(},"vertices":[)" + vertices + "]}";
}

/// A grid of 2 m cells under the houses, with its system in a .prj beside it.
fs::path writeGround(const test::TemporaryFolder& folder, const std::string& name, double height,
                     double east = 690'000.0) {
    std::string text =
        fmt::format("ncols 120\nnrows 60\nxllcorner {}\nyllcorner 5335000\ncellsize 2\n", east);
    for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 120; ++i)
            text += fmt::format("{} ", height);
        text += "\n";
    }
    return folder.write(name, text);
}

ImportRequest requestOf(const test::TemporaryFolder& folder, double base) {
    ImportRequest request;
    request.files = {folder.write("town.city.json", houses(base))};
    request.crs = "EPSG:25832";
    request.output = folder / "town.reflet";
    return request;
}

std::size_t ofId(const CityModel& city, const std::string& id) {
    return std::size_t(std::count_if(city.objects.begin(), city.objects.end(),
                                     [&](const CityObject& o) { return o.id == id; }));
}

TEST(GroundModels, ATerrainTakesThePlaceOfTheGeneratedGround) {
    const test::TemporaryFolder folder;
    ImportRequest request = requestOf(folder, 500.0);
    request.terrain = {writeGround(folder, "ground.asc", 500.0)};
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_FALSE(report->city->generatedGround);
    EXPECT_EQ(report->city->files.size(), 2U);
    const auto project = loadProject(request.output);
    ASSERT_TRUE(project);
    ASSERT_EQ(project->models.size(), 2U);
    EXPECT_EQ(project->models[1].path, "ground.asc");
    EXPECT_EQ(project->models[1].use, ModelUse::Terrain);
    const auto city = PreparedCity::prepare(*project, request.output, {});
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_FALSE(city->loaded().generatedGround);
    EXPECT_EQ(ofId(city->city(), "ground"), 1U);
    EXPECT_EQ(ofId(city->city(), "reflet-generated-ground"), 0U);
    const glm::dvec3 place = city->inFrame({690'020.0, 5'335'030.0, 0.0});
    EXPECT_NEAR(city->groundHeight(place.x, place.y), 500.0, 1e-3);
}

TEST(GroundModels, TilesThatAreModelsOfTheirOwnMakeOneGround) {
    const test::TemporaryFolder folder;
    ImportRequest request = requestOf(folder, 500.0);
    request.terrain = {writeGround(folder, "a.asc", 500.0),
                       writeGround(folder, "b.asc", 500.0, 690'240.0)};
    ASSERT_TRUE(importProject(request, {}));
    const auto city = PreparedCity::open(request.output, {});
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_EQ(ofId(city->city(), "a"), 1U);
    EXPECT_EQ(ofId(city->city(), "b"), 0U) << "it went into the first";
    // On the seam there is ground too.
    const glm::dvec3 seam = city->inFrame({690'240.0, 5'335'030.0, 0.0});
    EXPECT_NEAR(city->groundHeight(seam.x, seam.y), 500.0, 1e-3);
    EXPECT_EQ(city->loaded().files.size(), 3U);
}

TEST(GroundModels, AFolderOfTilesIsOneModelAndItsChangeIsSeen) {
    const test::TemporaryFolder folder;
    ImportRequest request = requestOf(folder, 500.0);
    writeGround(folder, "dem/a.asc", 500.0);
    writeGround(folder, "dem/b.asc", 500.0, 690'240.0);
    request.terrain = {folder / "dem"};
    ASSERT_TRUE(importProject(request, {}));
    const auto before = PreparedCity::open(request.output, {});
    ASSERT_TRUE(before) << before.error().message();
    EXPECT_TRUE(before->loaded().remarks.empty());
    writeGround(folder, "dem/b.asc", 501.0, 690'240.0);
    const auto after = PreparedCity::open(request.output, {});
    ASSERT_TRUE(after);
    EXPECT_NE(after->loaded().contentHash, before->loaded().contentHash);
    ASSERT_EQ(after->loaded().remarks.size(), 1U);
    EXPECT_EQ(after->loaded().remarks.front().code, "model-changed");
}

TEST(GroundModels, TheGroundFitTellsEllipsoidalHeightsFromThoseAboveTheSea) {
    const test::TemporaryFolder folder;
    for (const double undulation : {0.4, 5.0, 46.3, -31.0, 200.0}) {
        SCOPED_TRACE(undulation);
        ImportRequest request = requestOf(folder, 500.0 + undulation);
        request.terrain = {writeGround(folder, "ground.asc", 500.0)};
        const auto report = importProject(request, {});
        ASSERT_TRUE(report) << report.error().message();
        const auto city = PreparedCity::open(request.output, {});
        ASSERT_TRUE(city);
        const auto fit = groundFit(city->city());
        ASSERT_TRUE(fit);
        EXPECT_EQ(fit->buildings, 4U);
        EXPECT_NEAR(fit->median, undulation, 2e-3);
        const auto said = std::find_if(report->remarks.begin(), report->remarks.end(),
                                       [](const Diagnostic& d) { return d.code == "ground-fit"; });
        ASSERT_EQ(said != report->remarks.end(), std::abs(undulation) > 2.0);
        if (said == report->remarks.end())
            continue;
        EXPECT_EQ(said->text.find("ellipsoid") != std::string::npos,
                  std::abs(undulation) > 20.0 && std::abs(undulation) < 60.0);
    }
}

TEST(GroundModels, WithoutTerrainOrBuildingsThereIsNoFit) {
    const test::TemporaryFolder folder;
    const ImportRequest request = requestOf(folder, 500.0);
    ASSERT_TRUE(importProject(request, {}));
    const auto city = PreparedCity::open(request.output, {});
    ASSERT_TRUE(city);
    EXPECT_TRUE(city->loaded().generatedGround);
    EXPECT_FALSE(groundFit(city->city())) << "a generated ground proves nothing";
}

TEST(GroundModels, ATerrainAloneMakesAProject) {
    const auto terrain = test::sharedData("geotiff/goteborg-dsm.tif");
    if (!terrain)
        GTEST_SKIP() << test::kNoSharedData;
    const test::TemporaryFolder folder;
    ImportRequest request;
    request.files = {*terrain};
    request.output = folder / "goteborg.reflet";
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_EQ(report->project.frame.crs, "EPSG:3007");
    EXPECT_EQ(report->project.frame.origin, glm::dvec3(148'000, 6'399'000, 0));
    EXPECT_EQ(report->project.models.front().use, ModelUse::Terrain);
    EXPECT_TRUE(PreparedCity::open(request.output, {}));
}

TEST(GroundModels, AnOrthophotoGivesTheGroundItsColours) {
    const auto picture = test::sharedData("geotiff/manila-ortho.tif");
    if (!picture)
        GTEST_SKIP() << test::kNoSharedData;
    const test::TemporaryFolder folder;
    std::string text = "ncols 90\nnrows 90\nxllcorner 13467540\nyllcorner 1631820\ncellsize 2\n";
    for (int k = 0; k < 90 * 90; ++k)
        text += "3 ";
    ImportRequest request;
    request.terrain = {folder.write("ground.asc", text)};
    request.orthophotos = {*picture};
    request.crs = "EPSG:3395";
    request.output = folder / "manila.reflet";
    const auto report = importProject(request, {});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_EQ(report->project.models.back().use, ModelUse::Orthophoto);
    const auto city = PreparedCity::open(request.output, {});
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_FALSE(city->city().textures.empty());
    const auto drawn = city->drawn({});
    ASSERT_TRUE(drawn);
    EXPECT_TRUE(city->remarks().empty()) << city->remarks().front().text;
    // The river is brown: the colours are those of the file.
    double sum[3] = {0.0, 0.0, 0.0};
    std::size_t count = 0;
    for (const TextureImage& image : *(*drawn)->textures) {
        ASSERT_GT(image.width, 0);
        for (std::size_t k = 0; k < image.rgba.size(); k += 4) {
            if (image.rgba[k + 3] < 255)
                continue;
            ++count;
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += image.rgba[k + c];
        }
    }
    ASSERT_GT(count, 1'000'000U);
    EXPECT_NEAR(sum[0] / double(count), 101.7, 12.0);
    EXPECT_NEAR(sum[1] / double(count), 87.8, 12.0);
    EXPECT_NEAR(sum[2] / double(count), 58.4, 12.0);
}

TEST(GroundModels, ProjectsKeepTheUseAndThePlaceOfTheirModels) {
    Project project;
    project.models.emplace_back().path = "a.tif";
    project.models.back().use = ModelUse::Terrain;
    project.models.back().placement = ModelPlacement{{1.5, 2.5, 43.25}, 0.5, 1.25};
    project.models.emplace_back().path = "b.tif";
    project.models.back().use = ModelUse::Orthophoto;
    project.models.emplace_back().path = "c.city.json";
    const std::string text = projectToJson(project);
    const auto read = projectFromJson(text, "test");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->models[0].use, ModelUse::Terrain);
    EXPECT_EQ(read->models[0].placement->offset, project.models[0].placement->offset);
    EXPECT_NEAR(read->models[0].placement->heading, 0.5, 1e-10);
    EXPECT_EQ(read->models[0].placement->scale, 1.25);
    EXPECT_EQ(read->models[1].use, ModelUse::Orthophoto);
    EXPECT_EQ(read->models[2], project.models[2]);
    EXPECT_EQ(projectToJson(*read), text);
    std::string broken = text;
    broken.replace(broken.find("\"ortho\""), 7, "\"grass\"");
    EXPECT_FALSE(projectFromJson(broken, "test"));
}

}  // namespace
}  // namespace reflet
