// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/VehicleCache.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace reflet {
namespace {

using test::TemporaryFolder;

void expectEqual(const Vehicle& a, const Vehicle& b) {
    EXPECT_EQ(a.name, b.name);
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (std::size_t m = 0; m < a.materials.size(); ++m) {
        EXPECT_EQ(a.materials[m].name, b.materials[m].name);
        EXPECT_EQ(a.materials[m].baseColor, b.materials[m].baseColor);
        EXPECT_EQ(a.materials[m].clearCoat, b.materials[m].clearCoat);
        EXPECT_EQ(a.materials[m].metallic, b.materials[m].metallic);
        EXPECT_EQ(a.materials[m].glass, b.materials[m].glass);
        EXPECT_EQ(a.materials[m].emission, b.materials[m].emission);
    }
    ASSERT_EQ(a.bodies.size(), b.bodies.size());
    for (std::size_t k = 0; k < a.bodies.size(); ++k) {
        EXPECT_EQ(a.bodies[k].vertices, b.bodies[k].vertices);
        EXPECT_EQ(a.bodies[k].normals, b.bodies[k].normals);
        EXPECT_EQ(a.bodies[k].triangles, b.bodies[k].triangles);
        EXPECT_EQ(a.bodies[k].triangleMaterial, b.bodies[k].triangleMaterial);
        EXPECT_EQ(a.bodies[k].center, b.bodies[k].center);
        EXPECT_EQ(a.bodies[k].offset, b.bodies[k].offset);
        EXPECT_EQ(a.bodies[k].pivotSpan, b.bodies[k].pivotSpan);
        EXPECT_EQ(a.bodies[k].pivotMiddle, b.bodies[k].pivotMiddle);
    }
}

class VehicleCacheTest : public testing::Test {
protected:
    void overwrite(const std::string& bytes) {
        std::ofstream(cache.pathOf("car"), std::ios::binary | std::ios::trunc) << bytes;
    }

    TemporaryFolder folder;
    VehicleCache cache{folder / "p.cache"};
    Vehicle car = *builtInVehicle("car");
};

TEST_F(VehicleCacheTest, GivesBackWhatWasModelledBitForBit) {
    EXPECT_FALSE(cache.find("car").has_value());
    const auto first = builtInVehicle("car", cache);
    ASSERT_TRUE(first.has_value());
    expectEqual(*first, car);
    const auto kept = cache.find("car");
    ASSERT_TRUE(kept.has_value()) << "it was kept";
    expectEqual(*kept, car);
    EXPECT_FALSE(cache.find("bus").has_value()) << "each under its own name";
}

TEST_F(VehicleCacheTest, TheCacheIsWhatIsRead) {
    Vehicle painted = car;
    painted.materials.front().baseColor = {0.25F, 0.5F, 0.75F};
    ASSERT_TRUE(cache.store("car", painted).has_value());
    expectEqual(*builtInVehicle("car", cache), painted);
}

TEST_F(VehicleCacheTest, DamageOfAnyKindCountsAsAbsentAndIsMendedByModellingAgain) {
    ASSERT_TRUE(cache.store("car", car).has_value());
    const std::string sound = test::bytesOf(cache.pathOf("car"));
    for (const std::size_t length :
         {std::size_t(0), std::size_t(7), std::size_t(39), sound.size() / 2, sound.size() - 1}) {
        overwrite(sound.substr(0, length));
        EXPECT_FALSE(cache.find("car").has_value()) << length;
    }
    for (const std::size_t place :
         {std::size_t(0), std::size_t(10), std::size_t(41), sound.size() / 3, sound.size() - 1}) {
        std::string damaged = sound;
        damaged[place] = char(damaged[place] ^ 0x40);
        overwrite(damaged);
        EXPECT_FALSE(cache.find("car").has_value()) << place;
    }
    overwrite(sound + "x");
    EXPECT_FALSE(cache.find("car").has_value()) << "something after its end";
    expectEqual(*builtInVehicle("car", cache), car);
    EXPECT_EQ(test::bytesOf(cache.pathOf("car")), sound) << "and kept anew";
}

TEST_F(VehicleCacheTest, IndicesThatLeadNowhereAreRefusedThoughTheHashIsRight) {
    Vehicle wrong = car;
    wrong.bodies.front().triangles.front().y = std::uint32_t(wrong.bodies.front().vertices.size());
    ASSERT_TRUE(cache.store("car", wrong).has_value());
    EXPECT_FALSE(cache.find("car").has_value());
    wrong = car;
    wrong.bodies.front().triangleMaterial.front() = std::uint16_t(wrong.materials.size());
    ASSERT_TRUE(cache.store("car", wrong).has_value());
    EXPECT_FALSE(cache.find("car").has_value());
    wrong = car;
    wrong.bodies.front().normals.pop_back();
    ASSERT_TRUE(cache.store("car", wrong).has_value());
    EXPECT_FALSE(cache.find("car").has_value());
}

TEST_F(VehicleCacheTest, AFolderThatCannotBeMadeCostsNothingButTime) {
    const VehicleCache nowhere(folder.write("file", "no folder"));
    expectEqual(*builtInVehicle("car", nowhere), car);
    EXPECT_FALSE(builtInVehicle("zeppelin", nowhere).has_value());
}

}  // namespace
}  // namespace reflet
