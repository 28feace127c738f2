// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/CityModel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace reflet {
namespace {

/// Adds a box-shaped object; with its bottom, walls and roof it has twelve triangles.
void addBox(CityModel& city, const glm::vec3& low, const glm::vec3& high,
            CityObjectType type = CityObjectType::Building) {
    CityObject object;
    object.id = "box-" + std::to_string(city.objects.size());
    object.type = type;
    CitySurface surface;
    surface.object = std::uint32_t(city.objects.size());
    city.objects.push_back(object);
    city.surfaces.push_back(surface);
    const auto first = std::uint32_t(city.vertices.size());
    for (int k = 0; k < 8; ++k)
        city.vertices.emplace_back((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                                   (k & 4) != 0 ? high.z : low.z);
    constexpr std::uint32_t kQuads[6][4]{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : kQuads)
        for (int half = 0; half < 2; ++half)
            city.triangles.push_back(
                {{first + q[0], first + q[1 + half], first + q[2 + half]}, surface.object});
}

/// size × size buildings every 40 m, 20 m wide, standing on `height`.
CityModel cityOn(int size, const std::function<double(double, double)>& height) {
    CityModel city;
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
            const float x = 40.0F * float(i);
            const float y = 40.0F * float(j);
            const auto z = float(height(x + 10.0, y + 10.0));
            addBox(city, {x, y, z}, {x + 20.0F, y + 20.0F, z + 12.0F});
        }
    return city;
}

/// The generated ground's triangles and a lookup of its height, by trying all of them.
struct Ground {
    explicit Ground(const CityModel& model) : city(model) {
        for (std::size_t t = 0; t < city.triangles.size(); ++t)
            if (city.objects[city.surfaces[city.triangles[t].surface].object].id ==
                "reflet-generated-ground")
                triangles.push_back(t);
    }
    [[nodiscard]] glm::dvec3 corner(std::size_t t, std::size_t k) const {
        return city.vertices[city.triangles[t].vertex[k]];
    }
    [[nodiscard]] double at(double x, double y) const {
        for (const std::size_t t : triangles) {
            const glm::dvec3 a = corner(t, 0);
            const glm::dvec3 b = corner(t, 1) - a;
            const glm::dvec3 c = corner(t, 2) - a;
            const double det = b.x * c.y - b.y * c.x;
            const double u = ((x - a.x) * c.y - (y - a.y) * c.x) / det;
            const double v = (b.x * (y - a.y) - b.y * (x - a.x)) / det;
            if (u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9)
                return a.z + u * b.z + v * c.z;
        }
        return std::nan("");
    }
    const CityModel& city;
    std::vector<std::size_t> triangles;
};

TEST(GeneratedGround, IsFlatJustBelowTheBasesOfAFlatCityAndCoversItsMargin) {
    CityModel city = cityOn(5, [](double, double) { return 3.0; });
    ASSERT_TRUE(addGeneratedGround(city, 50.0));
    const Ground ground(city);
    ASSERT_FALSE(ground.triangles.empty());
    Box box;
    for (const std::size_t t : ground.triangles) {
        EXPECT_NEAR(city.normal(t).z, 1.0F, 1e-6F);
        for (std::size_t k = 0; k < 3; ++k)
            box.add(ground.corner(t, k));
    }
    EXPECT_NEAR(box.min.x, -50.0, 1e-3);
    EXPECT_NEAR(box.min.y, -50.0, 1e-3);
    EXPECT_NEAR(box.max.x, 230.0, 1e-3);
    EXPECT_NEAR(box.max.y, 230.0, 1e-3);
    EXPECT_NEAR(box.min.z, 2.95, 1e-5);
    EXPECT_NEAR(box.max.z, 2.95, 1e-5);
}

TEST(GeneratedGround, FollowsAHillsideAndNeverRisesAboveABase) {
    const auto hill = [](double x, double y) { return 100.0 + 0.08 * x - 0.03 * y; };
    CityModel city = cityOn(12, hill);
    ASSERT_TRUE(addGeneratedGround(city, 30.0));
    const Ground ground(city);
    for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 12; ++i)
            for (int corner = 0; corner < 5; ++corner) {
                const double x = 40.0 * i + (corner == 4 ? 10.0 : 20.0 * (corner % 2));
                const double y = 40.0 * j + (corner == 4 ? 10.0 : 20.0 * double(corner / 2));
                const double base = hill(40.0 * i + 10.0, 40.0 * j + 10.0);
                const double z = ground.at(x, y);
                EXPECT_LT(z, base);
                EXPECT_GT(z, base - 0.5) << "the wall hangs in the air at " << x << ", " << y;
            }
    // Between the buildings it runs on with the hill.
    EXPECT_NEAR(ground.at(230.0, 230.0), hill(230.0, 230.0), 2.0);
}

TEST(GeneratedGround, IsNowhereSteeperThanHalfARightAngleAlongTheGrid) {
    CityModel city;
    addBox(city, {0, 0, 0}, {20, 20, 10});
    addBox(city, {40, 0, 15}, {60, 20, 30});
    addBox(city, {0, 100, 4}, {60, 120, 30});
    ASSERT_TRUE(addGeneratedGround(city, 20.0));
    const Ground ground(city);
    double steepest = 0.0;
    for (const std::size_t t : ground.triangles) {
        const glm::dvec3 ab = ground.corner(t, 1) - ground.corner(t, 0);
        steepest = std::max(steepest, std::abs(ab.z) / std::hypot(ab.x, ab.y));
    }
    EXPECT_LE(steepest, 1.0 + 1e-5);
    EXPECT_GT(steepest, 0.1);
}

TEST(GeneratedGround, IgnoresABuildingThatWasLeftAtHeightZeroInAHighCity) {
    CityModel city = cityOn(10, [](double x, double) { return 400.0 + 0.02 * x; });
    addBox(city, {25, 25, 0}, {35, 35, 10});
    ASSERT_TRUE(addGeneratedGround(city, 30.0));
    EXPECT_GT(Ground(city).at(30.0, 30.0), 399.0);
}

TEST(GeneratedGround, DoesNotHangFromABridgeOrSinkIntoATunnel) {
    CityModel city = cityOn(4, [](double, double) { return 7.0; });
    addBox(city, {22, 0, 15}, {38, 140, 16}, CityObjectType::Bridge);
    addBox(city, {0, 22, -20}, {140, 38, -12}, CityObjectType::Tunnel);
    ASSERT_TRUE(addGeneratedGround(city, 10.0));
    const Ground ground(city);
    EXPECT_NEAR(ground.at(30.0, 70.0), 6.95, 1e-5);
    EXPECT_NEAR(ground.at(70.0, 30.0), 6.95, 1e-5);
}

TEST(GeneratedGround, StandsOnTreesWhereThereIsNothingElse) {
    CityModel city;
    addBox(city, {0, 0, 2}, {1, 1, 9}, CityObjectType::SolitaryVegetation);
    addBox(city, {50, 50, 4}, {51, 51, 9}, CityObjectType::SolitaryVegetation);
    ASSERT_TRUE(addGeneratedGround(city, 5.0));
    const Ground ground(city);
    EXPECT_NEAR(ground.at(0.5, 0.5), 1.95, 1e-5);
    EXPECT_NEAR(ground.at(50.5, 50.5), 3.95, 1e-5);
    EXPECT_GT(ground.at(25.0, 25.0), 1.95);
    EXPECT_LT(ground.at(25.0, 25.0), 3.95);
}

TEST(GeneratedGround, LeavesACityWithTerrainOrWithoutTrianglesAlone) {
    CityModel city = cityOn(2, [](double, double) { return 0.0; });
    addBox(city, {0, 30, 0}, {60, 38, 0.2}, CityObjectType::Road);
    const std::size_t before = city.triangles.size();
    EXPECT_FALSE(addGeneratedGround(city, 50.0));
    EXPECT_EQ(city.triangles.size(), before);
    CityModel empty;
    EXPECT_FALSE(addGeneratedGround(empty, 50.0));
}

TEST(GeneratedGround, IsMarkedAsOneTerrainObjectWithoutAMaterial) {
    CityModel city = cityOn(2, [](double, double) { return 0.0; });
    city.uv.resize(city.triangles.size());
    ASSERT_TRUE(addGeneratedGround(city, 5.0));
    EXPECT_EQ(city.objects.back().id, "reflet-generated-ground");
    EXPECT_EQ(city.objects.back().type, CityObjectType::TinRelief);
    EXPECT_EQ(city.uv.size(), city.triangles.size());
    const CitySurface& surface = city.surfaces[city.triangles.back().surface];
    EXPECT_EQ(surface.object, city.objects.size() - 1);
    EXPECT_GE(surface.material, city.materials.size()) << "a colour of its own would hide its look";
    EXPECT_FALSE(addGeneratedGround(city, 5.0));  // it is terrain now
}

TEST(GeneratedGround, StaysBelowFortyThousandTrianglesForAHundredThousandBuildings) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(0.0F, 20'000.0F);
    CityModel city;
    for (int i = 0; i < 100'000; ++i) {
        const glm::vec3 low(place(random), place(random), 0.0F);
        const glm::vec3 at(low.x, low.y, 30.0F * std::sin(low.x / 3000.0F));
        addBox(city, at, at + glm::vec3(10.0F));
    }
    const std::size_t before = city.triangles.size();
    ASSERT_TRUE(addGeneratedGround(city, 100.0));
    EXPECT_GT(city.triangles.size() - before, 30'000U);
    EXPECT_LE(city.triangles.size() - before, 40'000U);
}

TEST(GeneratedGround, StaysSmallForALongThinCityAndForTwoFarAwayClusters) {
    CityModel city;
    for (int i = 0; i < 300; ++i) {
        const float x = 20.0F * float(i) + (i > 150 ? 3.0e6F : 0.0F);
        addBox(city, {x, 0, 5}, {x + 10, 10, 15});
    }
    const std::size_t before = city.triangles.size();
    ASSERT_TRUE(addGeneratedGround(city, 20.0));
    EXPECT_LE(city.triangles.size() - before, 40'000U);
    for (std::size_t t = before; t < city.triangles.size(); ++t)
        for (const std::uint32_t v : city.triangles[t].vertex)
            EXPECT_NEAR(city.vertices[v].z, 4.95F, 1e-4F);
}

TEST(GeneratedGround, IsTheSameBitByBitForShuffledObjects) {
    const auto hill = [](double x, double y) { return 5.0 + 0.05 * x + std::sin(y / 30.0); };
    CityModel city = cityOn(6, hill);
    CityModel reversed;
    for (int j = 5; j >= 0; --j)
        for (int i = 5; i >= 0; --i) {
            const float x = 40.0F * float(i);
            const float y = 40.0F * float(j);
            const auto z = float(hill(x + 10.0, y + 10.0));
            addBox(reversed, {x, y, z}, {x + 20.0F, y + 20.0F, z + 12.0F});
        }
    const std::size_t first = city.vertices.size();
    ASSERT_TRUE(addGeneratedGround(city, 50.0));
    ASSERT_TRUE(addGeneratedGround(reversed, 50.0));
    ASSERT_EQ(city.vertices.size(), reversed.vertices.size());
    for (std::size_t v = first; v < city.vertices.size(); ++v)
        EXPECT_EQ(city.vertices[v], reversed.vertices[v]);
}

}  // namespace
}  // namespace reflet
