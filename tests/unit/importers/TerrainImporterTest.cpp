// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/Crs.h"
#include "importers/FormatRegistry.h"
#include "importers/terrain/TerrainImporter.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace reflet {
namespace {

namespace fs = std::filesystem;
using HeightOf = std::function<double(double east, double north)>;

/// An ASCII grid whose lower left corner is (east, north); posts stand at the centres of its cells.
std::string grid(int columns, int rows, double east, double north, double cell,
                 const HeightOf& height) {
    std::string text = fmt::format(
        "ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value -32768\n",
        columns, rows, east, north, cell);
    for (int j = rows - 1; j >= 0; --j) {
        for (int i = 0; i < columns; ++i)
            text += fmt::format("{} ", height(east + (i + 0.5) * cell, north + (j + 0.5) * cell));
        text += "\n";
    }
    return text;
}

double hill(double east, double north) {
    return 30.0 + 5.0 * std::sin(0.05 * east) + 4.0 * std::cos(0.07 * north) +
           0.5 * std::sin(1.3 * east * north);
}

Imported<CityImport> imported(const std::vector<fs::path>& files, ImportOptions options = {},
                              const TerrainOptions& terrain = {}) {
    if (options.crs.empty())
        options.crs = "local";
    auto result = importTerrain(files, options, terrain, {});
    EXPECT_TRUE(result) << result.error().message();
    return result ? std::move(*result) : Imported<CityImport>{};
}

bool says(const std::vector<Diagnostic>& diagnostics, const std::string& code) {
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [&](const Diagnostic& d) { return d.code == code; });
}

/// Edges of triangles that only one has, within the box of the model.
std::size_t openEdgesInside(const CityModel& city) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const CityTriangle& t : city.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            ++uses[std::minmax(t.vertex[k], t.vertex[(k + 1) % 3])];
    const Box box = city.bounds();
    const auto onRim = [&](std::uint32_t v) {
        const glm::dvec3 p(city.vertices[v]);
        return p.x == box.min.x || p.x == box.max.x || p.y == box.min.y || p.y == box.max.y;
    };
    return std::size_t(std::count_if(uses.begin(), uses.end(), [&](const auto& use) {
        return use.second == 1 && !(onRim(use.first.first) && onRim(use.first.second));
    }));
}

TEST(TerrainImporter, PutsEveryPostAtTheCentreOfItsCell) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("t.asc", grid(7, 5, 1000, 2000, 10, hill));
    const auto result = imported({file}, {}, {.error = 0.0});
    const CityModel& city = result.value.city;
    ASSERT_EQ(city.vertices.size(), 35U);
    EXPECT_EQ(city.triangles.size(), 2U * 6U * 4U);
    for (const glm::vec3& v : city.vertices) {
        const glm::dvec3 p = glm::dvec3(v) + city.frame.origin;
        EXPECT_NEAR(std::remainder(p.x - 1005.0, 10.0), 0.0, 1e-9);
        EXPECT_NEAR(p.z, hill(p.x, p.y), 6e-4) << p.x << " " << p.y;
    }
    EXPECT_EQ(city.bounds().min.x + city.frame.origin.x, 1005.0);
    EXPECT_EQ(city.bounds().max.y + city.frame.origin.y, 2045.0);
    ASSERT_EQ(city.objects.size(), 1U);
    EXPECT_EQ(city.objects.front().type, CityObjectType::TinRelief);
    EXPECT_EQ(result.counts.loaded, 1U);
    for (std::size_t t = 0; t < city.triangles.size(); ++t)
        EXPECT_GT(city.normal(t).z, 0.0F) << "fronts look up";
}

TEST(TerrainImporter, TilesThatFitLeaveNoSeamWhetherTheyTouchOrOverlap) {
    const test::TemporaryFolder folder;
    // The second continues the first, the third repeats one column of the second.
    const auto a = folder.write("a.asc", grid(20, 15, 0, 0, 2, hill));
    const auto b = folder.write("b.asc", grid(20, 15, 40, 0, 2, hill));
    const auto c = folder.write("c.asc", grid(20, 15, 78, 0, 2, hill));
    const auto whole = folder.write("whole.asc", grid(59, 15, 0, 0, 2, hill));
    const auto tiles = imported({a, b, c}, {}, {.error = 0.0});
    const auto one = imported({whole}, {}, {.error = 0.0});
    EXPECT_EQ(tiles.value.city.objects.size(), 1U);
    EXPECT_EQ(openEdgesInside(tiles.value.city), 0U);
    EXPECT_EQ(tiles.value.city.vertices, one.value.city.vertices);
    EXPECT_EQ(tiles.value.city.triangles.size(), one.value.city.triangles.size());
}

TEST(TerrainImporter, GridsOfOtherPhaseAreSeparateAndSaid) {
    const test::TemporaryFolder folder;
    const auto a = folder.write("a.asc", grid(5, 5, 0, 0, 2, hill));
    const auto b = folder.write("b.asc", grid(5, 5, 100.7, 0, 2, hill));
    const auto result = imported({a, b});
    EXPECT_EQ(result.value.city.objects.size(), 2U);
    EXPECT_TRUE(says(result.diagnostics, "terrain-grids"));
}

TEST(TerrainImporter, MissingHeightsMakeHolesAndNoCliffs) {
    const test::TemporaryFolder folder;
    const auto height = [](double east, double north) {
        return east > 20 && east < 40 && north > 20 && north < 40 ? -32768.0 : 100.0;
    };
    const auto file = folder.write("t.asc", grid(30, 30, 0, 0, 2, height));
    const auto result = imported({file});
    for (const glm::vec3& v : result.value.city.vertices)
        EXPECT_EQ(v.z, 100.0F);
    EXPECT_TRUE(says(result.diagnostics, "no-data"));
    EXPECT_GT(openEdgesInside(result.value.city), 0U) << "the hole is there";
}

TEST(TerrainImporter, UndeclaredNoDataIsRecognised) {
    const test::TemporaryFolder folder;
    for (const double leftover : {-9999.0, 1e30, -3.4e38}) {
        const auto height = [&](double east, double) { return east < 10 ? leftover : 7.0; };
        const auto file = folder.write("t.asc", grid(30, 30, 0, 0, 2, height));
        const auto result = imported({file});
        ASSERT_FALSE(result.value.city.vertices.empty());
        for (const glm::vec3& v : result.value.city.vertices)
            EXPECT_EQ(v.z, 7.0F);
        EXPECT_TRUE(says(result.diagnostics, "undeclared-no-data"));
    }
}

TEST(TerrainImporter, ReadsThePartThatIsAskedFor) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("t.asc", grid(200, 200, 0, 0, 1, hill));
    ImportOptions options;
    options.bbox = {{50.2, 60.3, 90.7, 80.1}};
    const auto result = imported({file}, options, {.error = 0.0});
    const Box box = result.value.city.bounds();
    EXPECT_EQ(box.min + result.value.city.frame.origin, glm::dvec3(49.5, 59.5, box.min.z));
    EXPECT_EQ(glm::dvec2(box.max + result.value.city.frame.origin), glm::dvec2(91.5, 80.5));
    options.bbox = {{1000, 1000, 1100, 1100}};
    const auto beside = imported({file}, options);
    EXPECT_TRUE(beside.value.city.triangles.empty());
    EXPECT_TRUE(says(beside.diagnostics, "outside"));
}

TEST(TerrainImporter, OfTooManyPostsEverySecondIsTakenAndTheErrorOfTheRestIsTold) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("t.asc", grid(101, 101, 0, 0, 1, hill));
    const auto result = imported({file}, {}, {.error = 0.1, .mostPosts = 4000});
    EXPECT_TRUE(says(result.diagnostics, "decimated"));
    EXPECT_LE(result.value.city.vertices.size(), 4000U);
    EXPECT_FALSE(result.value.city.triangles.empty());
    EXPECT_EQ(openEdgesInside(result.value.city), 0U);
}

TEST(TerrainImporter, AGridInDegreesComesIntoMetresPostByPost) {
    const test::TemporaryFolder folder;
    const auto file = folder.write(
        "t.asc", grid(11, 11, 13.4, 52.5, 0.001, [](double e, double n) { return 10 * e + n; }));
    ImportOptions options;
    options.crs = "EPSG:4326";
    const auto result = imported({file}, options, {.error = 0.0});
    const CityModel& city = result.value.city;
    ASSERT_EQ(city.frame.crs, "EPSG:32633");
    const auto back = CrsTransform::create(*Crs::parse("EPSG:32633"), *Crs::parse("EPSG:4326"));
    ASSERT_TRUE(back);
    ASSERT_EQ(city.vertices.size(), 121U);
    for (const glm::vec3& v : city.vertices) {
        const auto degrees = back->apply(glm::dvec3(v) + city.frame.origin);
        ASSERT_TRUE(degrees);
        EXPECT_NEAR(double(v.z), 10 * degrees->x + degrees->y, 6e-4);
        EXPECT_NEAR(std::remainder(degrees->x - 13.4005, 0.001), 0.0, 2e-8);
    }
}

TEST(TerrainImporter, HeightsInFeetBecomeMetres) {
    const test::TemporaryFolder folder;
    const auto file =
        folder.write("t.asc", grid(4, 4, 980000, 200000, 10, [](double, double) { return 100.0; }));
    ImportOptions options;
    options.crs = "EPSG:2263";  // New York, US survey feet
    const auto result = imported({file}, options);
    ASSERT_FALSE(result.value.city.vertices.empty());
    EXPECT_NEAR(result.value.city.vertices.front().z, 30.48006, 1e-4);
    EXPECT_TRUE(says(result.diagnostics, "height-unit"));
}

TEST(TerrainImporter, ReadsTheSharedTerrainsWithTheirBoundsAndHeights) {
    const auto path = test::sharedData("geotiff/goteborg-dem.tif");
    const auto alps = test::sharedData("geotiff/vinschgau-dem.tif");
    if (!path || !alps)
        GTEST_SKIP() << test::kNoSharedData;
    const auto result = importTerrain({*path}, {}, {.error = 0.0}, {});
    ASSERT_TRUE(result) << result.error().message();
    const CityModel& city = result->value.city;
    EXPECT_EQ(city.frame.crs, "EPSG:3007");
    EXPECT_EQ(city.vertices.size(), 52182U);
    const glm::dvec3 low = city.bounds().min + city.frame.origin;
    const glm::dvec3 high = city.bounds().max + city.frame.origin;
    EXPECT_EQ(glm::dvec2(low), glm::dvec2(147720.5, 6398557.5));
    EXPECT_EQ(glm::dvec2(high), glm::dvec2(147953.5, 6398779.5));
    EXPECT_NEAR(low.z, 0.0068, 6e-4);
    EXPECT_NEAR(high.z, 23.2055, 6e-4);

    const auto relief = importTerrain({*alps}, {}, {.error = 0.0}, {});
    ASSERT_TRUE(relief) << relief.error().message();
    EXPECT_EQ(relief->value.city.frame.crs, "EPSG:32632");
    EXPECT_LE(relief->value.city.vertices.size(), 48443U) << "no more than have a height";
    EXPECT_EQ(relief->value.city.bounds().min.z, 388.0);
    EXPECT_EQ(relief->value.city.bounds().max.z, 3863.0);
}

TEST(TerrainImporter, InspectsEverySharedGeoTiff) {
    const auto folder = test::sharedData("geotiff");
    if (!folder)
        GTEST_SKIP() << test::kNoSharedData;
    const auto seen = inspectRaster(*folder / "goteborg-dsm.tif", {}, {});
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->value.bounds.min, glm::dvec3(147720, 6398557, 0));
    EXPECT_NEAR(seen->value.bounds.max.z, 58.0704, 5.1e-5);
    EXPECT_EQ(seen->value.crsHorizontal, "EPSG:3007");
    EXPECT_EQ(seen->value.vertices, 52182U);
    EXPECT_EQ(rasterUse(*folder / "goteborg-dsm.tif"), RasterUse::Terrain);
    EXPECT_EQ(rasterUse(*folder / "manila-ortho.tif"), RasterUse::Orthophoto);
    const auto picture = inspectRaster(*folder / "manila-ortho.tif", {}, {});
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->value.crsHorizontal, "EPSG:3395");
    EXPECT_EQ(picture->value.raster.front().columns, 2048);
    EXPECT_EQ(picture->value.texturesReferenced, 1U);
}

TEST(TerrainImporter, RefusesPicturesAndTellsOfDamagedFiles) {
    const auto picture = test::sharedData("geotiff/manila-ortho.tif");
    const auto bad = test::sharedData("bad/geotiff");
    if (!picture || !bad)
        GTEST_SKIP() << test::kNoSharedData;
    EXPECT_EQ(importTerrain({*picture}, {}, {}, {}).error().code, ErrorCode::Refused);
    const std::map<std::string, ErrorCode> outcomes{
        {"corrupt1.tif", ErrorCode::Unreadable},
        {"fuzz-divide-by-zero-1.tif", ErrorCode::Unreadable},
        {"fuzz-oom-1.tif", ErrorCode::Refused},             // three bands
        {"strip-offset-past-eof.tif", ErrorCode::Refused},  // colours
        {"truncated-tile.tif", ErrorCode::Refused}};        // three bands
    for (const auto& [name, code] : outcomes) {
        ImportOptions options;
        options.crs = "local";
        const auto result = importTerrain({*bad / name}, options, {}, {});
        ASSERT_FALSE(result) << name;
        EXPECT_EQ(result.error().code, code) << result.error().message();
        EXPECT_FALSE(result.error().remedy.empty()) << name;
    }
}

TEST(TerrainImporter, FindsTheRastersOfAFolderAndOfAList) {
    const test::TemporaryFolder folder;
    folder.write("tiles/b.asc", grid(3, 3, 6, 0, 2, hill));
    folder.write("tiles/a.asc", grid(3, 3, 0, 0, 2, hill));
    folder.write("tiles/readme.md", "not a raster");
    const auto list = folder.write("list.txt", "# two tiles\ntiles/b.asc\r\ntiles/a.asc\n\n");
    const auto inFolder = rasterFiles(folder / "tiles");
    ASSERT_TRUE(inFolder);
    EXPECT_EQ(*inFolder, (std::vector<fs::path>{folder / "tiles/a.asc", folder / "tiles/b.asc"}));
    const auto inList = rasterFiles(list);
    ASSERT_TRUE(inList);
    EXPECT_EQ(*inList, (std::vector<fs::path>{folder / "tiles/b.asc", folder / "tiles/a.asc"}));
    EXPECT_EQ(rasterFiles(folder / "tiles/a.asc")->size(), 1U);
    EXPECT_EQ(rasterFiles(folder.path()).error().code, ErrorCode::Unreadable);
}

TEST(TerrainImporter, IsTheFormatOfRastersByTheirContent) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("heights.dat", grid(3, 3, 6, 0, 2, hill));
    const auto format = cityFormatOf(file);
    ASSERT_TRUE(format) << format.error().message();
    ImportOptions options;
    options.crs = "local";
    const auto result = (*format)->read(file, options, {});
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(result->value.city.objects.front().id, "heights");
}

TEST(TerrainImporter, ACancelledJobSaysSo) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("t.asc", grid(30, 30, 0, 0, 1, hill));
    std::stop_source stop;
    stop.request_stop();
    ImportOptions options;
    options.crs = "local";
    const auto result = importTerrain({file}, options, {}, JobContext({}, stop.get_token()));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace reflet
