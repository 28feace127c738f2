// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/CityModel.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace reflet {
namespace {

CityModel triangleCity(const std::string& id) {
    CityModel city;
    city.objects.resize(2);
    city.objects[0].id = id;
    city.objects[1].id = id + "-part";
    city.objects[1].parent = 0;
    city.materials.resize(1);
    city.materials[0].name = id;
    city.textures.resize(1);
    city.textures[0].reference = id + ".png";
    city.surfaces.resize(2);
    city.surfaces[0] = {0, SurfaceType::Roof, 0, kNone, false};
    city.surfaces[1] = {1, SurfaceType::Wall, kNone, 0, true};
    city.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}};
    city.triangles = {{{0, 1, 2}, 0}, {{0, 3, 1}, 1}};
    return city;
}

TEST(CityModel, BoundsAreThoseOfTheTrianglesNotOfUnusedVertices) {
    CityModel city = triangleCity("a");
    city.vertices.emplace_back(1000, 1000, 1000);
    EXPECT_EQ(city.bounds().min, glm::dvec3(0.0));
    EXPECT_EQ(city.bounds().max, glm::dvec3(2, 3, 5));
    EXPECT_TRUE(CityModel().bounds().empty());
}

TEST(CityModel, TheNormalFollowsTheVertexOrderAndVanishesForADegenerateTriangle) {
    CityModel city = triangleCity("a");
    EXPECT_EQ(city.normal(0), glm::vec3(0, 0, 1));
    EXPECT_EQ(city.normal(1), glm::vec3(0, 1, 0));
    city.triangles[0].vertex = {0, 1, 1};
    EXPECT_EQ(city.normal(0), glm::vec3(0.0F));
}

TEST(CityModel, TheNormalOfASliverFarFromTheOriginHasUnitLength) {
    CityModel city;
    city.vertices = {{5000, 5000, 10}, {5000.001F, 5000, 10}, {5000, 5000, 60}};
    city.triangles = {{{0, 1, 2}, 0}};
    EXPECT_NEAR(glm::length(city.normal(0)), 1.0F, 1e-6F);
    EXPECT_NEAR(city.normal(0).y, -1.0F, 1e-6F);
}

TEST(CityModel, AppendShiftsEveryIndexButTheAbsentOnes) {
    CityModel city = triangleCity("a");
    append(city, triangleCity("b"));
    ASSERT_EQ(city.objects.size(), 4U);
    EXPECT_EQ(city.objects[3].parent, 2U);
    EXPECT_EQ(city.objects[0].parent, std::nullopt);
    const CitySurface& roof = city.surfaces[city.triangles[2].surface];
    const CitySurface& wall = city.surfaces[city.triangles[3].surface];
    EXPECT_EQ(city.objects[roof.object].id, "b");
    EXPECT_EQ(city.materials[roof.material].name, "b");
    EXPECT_EQ(roof.texture, kNone);
    EXPECT_EQ(wall.material, kNone);
    EXPECT_EQ(city.textures[wall.texture].reference, "b.png");
    EXPECT_TRUE(wall.instance);
    EXPECT_EQ(city.triangles[3].vertex, (std::array<std::uint32_t, 3>{4, 7, 5}));
    EXPECT_EQ(city.vertices.size(), 8U);
    EXPECT_TRUE(city.uv.empty());
}

TEST(CityModel, AppendKeepsOneTextureCoordinatePerTriangleWhenOnlyOneSideHasThem) {
    const std::array<glm::vec2, 3> corner{{{0, 0}, {1, 0}, {0, 1}}};
    CityModel with = triangleCity("a");
    with.uv = {corner, corner};
    CityModel first = with;
    append(first, triangleCity("b"));
    ASSERT_EQ(first.uv.size(), 4U);
    EXPECT_EQ(first.uv[1], corner);
    CityModel second = triangleCity("b");
    append(second, with);
    ASSERT_EQ(second.uv.size(), 4U);
    EXPECT_EQ(second.uv[0], (std::array<glm::vec2, 3>{}));
    EXPECT_EQ(second.uv[3], corner);
}

TEST(CityModel, TerrainIsWhatMakesUpTheBareGround) {
    EXPECT_TRUE(isTerrain(CityObjectType::TinRelief));
    EXPECT_TRUE(isTerrain(CityObjectType::Road));
    EXPECT_TRUE(isTerrain(CityObjectType::WaterBody));
    EXPECT_TRUE(isTerrain(CityObjectType::PlantCover));
    EXPECT_FALSE(isTerrain(CityObjectType::Building));
    EXPECT_FALSE(isTerrain(CityObjectType::Bridge));
    EXPECT_FALSE(isTerrain(CityObjectType::SolitaryVegetation));
}

TEST(CityModel, EveryTypeHasANameOfItsOwn) {
    std::set<std::string> names;
    for (int t = 0; t <= int(CityObjectType::Other); ++t)
        EXPECT_TRUE(names.insert(toString(CityObjectType(t))).second) << t;
    EXPECT_TRUE(names.contains("SolitaryVegetationObject"));
    EXPECT_TRUE(names.contains("TINRelief"));
    std::set<std::string> surfaces;
    for (int t = 0; t <= int(SurfaceType::Other); ++t)
        EXPECT_TRUE(surfaces.insert(toString(SurfaceType(t))).second) << t;
    EXPECT_TRUE(surfaces.contains("RoofSurface"));
}

}  // namespace
}  // namespace reflet
