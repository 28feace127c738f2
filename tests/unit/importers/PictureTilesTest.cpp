// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/terrain/Orthophoto.h"
#include "importers/terrain/PictureTiles.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace reflet::terrain {
namespace {

/// A sheet of two triangles over a square, its height a plane.
CityModel sheet(double edge) {
    CityModel city;
    city.objects.push_back({"ground", CityObjectType::TinRelief, "TINRelief", "", {}});
    city.surfaces.push_back({0, SurfaceType::Ground, kNone, kNone, false});
    for (const glm::dvec2 p : {glm::dvec2(0, 0), {edge, 0}, {edge, edge}, {0, edge}})
        city.vertices.emplace_back(p.x, p.y, 0.1 * p.x + 0.2 * p.y);
    city.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
    return city;
}

double planArea(const CityModel& city, bool textured) {
    double area = 0.0;
    for (const CityTriangle& t : city.triangles) {
        if ((city.surfaces[t.surface].texture != kNone) != textured)
            continue;
        const glm::dvec3 a(city.vertices[t.vertex[0]]);
        const glm::dvec3 b = glm::dvec3(city.vertices[t.vertex[1]]) - a;
        const glm::dvec3 c = glm::dvec3(city.vertices[t.vertex[2]]) - a;
        area += 0.5 * (b.x * c.y - b.y * c.x);
    }
    return area;
}

TEST(PictureTiles, CoverARectangleWithNoMoreTexturesThanAllowed) {
    const PictureGrid small = tileGrid({10, 20}, {110, 120}, 0.1, 100);
    EXPECT_EQ(small.pixel, 0.1);
    EXPECT_EQ(small.columns, 2);  // 1000 pixels of 672
    EXPECT_EQ(small.rows, 1);     // of 1014
    const PictureGrid large = tileGrid({0, 0}, {5000, 3000}, 0.1, 28);
    EXPECT_LE(large.columns * large.rows, 28);
    EXPECT_GE(large.columns * large.rows, 14) << "what may be used is used";
    EXPECT_GE(large.columns * large.tileSize().x, 5000.0);
    EXPECT_GE(large.rows * large.tileSize().y, 3000.0);
}

TEST(PictureTiles, CutTheGroundAtTheirRimsAndChangeNeitherAreaNorHeight) {
    CityModel city = sheet(300.0);
    PictureGrid grid;
    grid.min = {50.0, 40.0};
    grid.pixel = 0.1;
    grid.columns = 3;  // to 251.6
    grid.rows = 2;     // to 242.8
    layOn(city, {0, 1}, grid, {"a.tif", std::nullopt, {0.0, 0.0}});
    EXPECT_NEAR(planArea(city, true), 201.6 * 202.8, 0.05);
    EXPECT_NEAR(planArea(city, true) + planArea(city, false), 300.0 * 300.0, 0.05);
    for (const glm::vec3& v : city.vertices)
        EXPECT_NEAR(v.z, 0.1F * v.x + 0.2F * v.y, 1e-4F);
    EXPECT_EQ(city.textures.size(), 6U);
    ASSERT_EQ(city.uv.size(), city.triangles.size());
    std::set<std::pair<float, float>> places;
    for (const glm::vec3& v : city.vertices)
        EXPECT_TRUE(places.emplace(v.x, v.y).second) << "corners are shared";
}

TEST(PictureTiles, TextureCoordinatesLeadToTheSamePlaceInTheWindow) {
    CityModel city = sheet(300.0);
    const PictureGrid grid = tileGrid({0, 0}, {300, 300}, 0.25, 28);
    layOn(city, {0, 1}, grid, {"a.tif", "EPSG:25832", {-500000.0, -5600000.0}});
    EXPECT_EQ(planArea(city, false), 0.0);
    for (std::size_t t = 0; t < city.triangles.size(); ++t) {
        const CityTexture& texture =
            city.textures[city.surfaces[city.triangles[t].surface].texture];
        ASSERT_TRUE(texture.window);
        EXPECT_FALSE(texture.repeat);
        const PictureWindow& window = *texture.window;
        EXPECT_NEAR((window.max.x - window.min.x) / window.width, 0.25, 1e-9) << "square pixels";
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 shown =
                window.min + glm::dvec2(city.uv[t][k]) * (window.max - window.min);
            const glm::dvec2 place(city.vertices[city.triangles[t].vertex[k]]);
            EXPECT_NEAR(shown.x, place.x + 500000.0, 1e-3);
            EXPECT_NEAR(shown.y, place.y + 5600000.0, 1e-3);
            // A rim of four pixels is left, for filtering.
            EXPECT_GE(city.uv[t][k].x, 3.9F / 680.0F);
            EXPECT_LE(city.uv[t][k].y, 1.0F - 3.9F / 1022.0F);
        }
    }
}

TEST(Orthophoto, LiesOnBareGroundAlone) {
    const auto picture = test::sharedData("geotiff/manila-ortho.tif");
    if (!picture)
        GTEST_SKIP() << test::kNoSharedData;
    CityModel city = sheet(200.0);
    city.frame.crs = "EPSG:3395";
    city.frame.origin = {13467532.0, 1631815.0, 0.0};
    // The same sheet as a building's roof, as a road with a material, and as water.
    const CityModel one = city;
    for (const CityObjectType type :
         {CityObjectType::Building, CityObjectType::Road, CityObjectType::WaterBody}) {
        CityModel other = one;
        other.objects.front().type = type;
        if (type == CityObjectType::Road) {
            other.materials.push_back({"asphalt"});
            other.surfaces.front().material = 0;
        }
        append(city, other);
    }
    const auto remarks = drape(city, {{*picture, "", {0.0, 0.0}}}, {}, {});
    ASSERT_TRUE(remarks) << remarks.error().message();
    EXPECT_TRUE(remarks->empty());
    for (const CitySurface& surface : city.surfaces) {
        const CityObjectType type = city.objects[surface.object].type;
        if (type == CityObjectType::Building || type == CityObjectType::Road) {
            EXPECT_EQ(surface.texture, kNone);
        }
    }
    EXPECT_NEAR(planArea(city, true), 2.0 * 200.0 * (200.0 - 0.125), 1.0) << "it ends 12.5 cm up";
}

TEST(Orthophoto, SaysWhenItLiesBesideTheCityAndRefusesALocalOne) {
    const auto picture = test::sharedData("geotiff/manila-ortho.tif");
    const auto heights = test::sharedData("geotiff/goteborg-dem.tif");
    if (!picture || !heights)
        GTEST_SKIP() << test::kNoSharedData;
    CityModel city = sheet(200.0);
    const auto refused = drape(city, {{*picture, "", {0.0, 0.0}}}, {}, {});
    ASSERT_FALSE(refused) << "the city is in local metres";
    EXPECT_EQ(refused.error().code, ErrorCode::Refused);
    city.frame.crs = "EPSG:32651";
    city.frame.origin = {300000.0, 1600000.0, 0.0};
    const auto remarks = drape(city, {{*picture, "", {0.0, 0.0}}}, {}, {});
    ASSERT_TRUE(remarks) << remarks.error().message();
    ASSERT_EQ(remarks->size(), 1U);
    EXPECT_EQ(remarks->front().code, "orthophoto-beside");
    EXPECT_TRUE(city.textures.empty());
    EXPECT_EQ(drape(city, {{*heights, "", {0.0, 0.0}}}, {}, {}).error().code, ErrorCode::Refused)
        << "heights are no colours";
}

}  // namespace
}  // namespace reflet::terrain
