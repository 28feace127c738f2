// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/TerrainDraping.h"

#include <gtest/gtest.h>

#include <array>

namespace reflet {
namespace {

/// A slope z = x / 10 over 100 m by 100 m, and boxes on it.
class TerrainDrapingTest : public testing::Test {
protected:
    TerrainDrapingTest() {
        city.objects.push_back({"ground", CityObjectType::TinRelief, "TINRelief", "", {}});
        city.surfaces.push_back({0, SurfaceType::Ground});
        city.vertices = {{0, 0, 0}, {100, 0, 10}, {100, 100, 10}, {0, 100, 0}};
        city.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
    }
    /// A triangle of 10 m that stands at (x, y) with its corners at these heights.
    std::uint32_t add(double x, double y, float z, std::optional<std::uint32_t> parent = {}) {
        const auto object = std::uint32_t(city.objects.size());
        const auto first = std::uint32_t(city.vertices.size());
        city.objects.push_back({"house", CityObjectType::Building, "Building", "1", parent});
        city.surfaces.push_back({object, SurfaceType::Roof});
        city.vertices.emplace_back(x, y, z);
        city.vertices.emplace_back(x + 10, y, z);
        city.vertices.emplace_back(x, y + 10, z);
        city.triangles.push_back(
            {{first, first + 1, first + 2}, std::uint32_t(city.surfaces.size() - 1)});
        return object;
    }
    [[nodiscard]] float heightOf(std::uint32_t object) const {
        for (const CityTriangle& t : city.triangles) {
            if (city.surfaces[t.surface].object == object)
                return city.vertices[t.vertex[0]].z;
        }
        return -1.0F;
    }
    CityModel city;
};

TEST_F(TerrainDrapingTest, LiftsToTheLowestGroundUnderTheObject) {
    const auto house = add(50, 20, 3.0F);
    const std::array objects{house};
    EXPECT_EQ(drapeOnTerrain(city, objects), 1U);
    EXPECT_NEAR(heightOf(house), 5.0F + 3.0F, 1e-5);
    EXPECT_EQ(city.vertices[1].z, 10.0F);
}

TEST_F(TerrainDrapingTest, LeavesOthersAndWhatHasNoGroundBelow) {
    const auto other = add(50, 20, 3.0F), outside = add(500, 20, 3.0F);
    const std::array objects{outside};
    EXPECT_EQ(drapeOnTerrain(city, objects), 0U);
    EXPECT_EQ(heightOf(other), 3.0F);
    EXPECT_EQ(heightOf(outside), 3.0F);
}

TEST_F(TerrainDrapingTest, KeepsPartsOfOneBuildingTogether) {
    const auto house = add(20, 20, 0.0F);
    const auto part = add(60, 20, 4.0F, house);
    const std::array objects{house, part};
    EXPECT_EQ(drapeOnTerrain(city, objects), 2U);
    EXPECT_NEAR(heightOf(house), 2.0F, 1e-5);
    EXPECT_NEAR(heightOf(part), 6.0F, 1e-5);
}

TEST_F(TerrainDrapingTest, DoesNothingWithoutTerrain) {
    city = {};
    const auto house = add(0, 0, 3.0F);
    const std::array objects{house};
    EXPECT_EQ(drapeOnTerrain(city, objects), 0U);
    EXPECT_EQ(heightOf(house), 3.0F);
}

}  // namespace
}  // namespace reflet
