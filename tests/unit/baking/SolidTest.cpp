// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/baking/BakingScenes.h"

namespace reflet::testing {
namespace {

TEST(InsideSolid, AClosedBuildingIsSolidInsideAndNotOutsideWhicheverWayItsFacesLook) {
    for (const bool inverted : {false, true}) {
        SceneBuilder b;
        b.box(b.object("a", CityObjectType::Building), {0, 0, 0}, {12, 9, 10}, kNone, inverted);
        b.box(b.object("b", CityObjectType::Building), {0, 20, 0}, {12, 29, 10}, kNone, inverted);
        ASSERT_TRUE(addGeneratedGround(b.city, 30.0));
        const auto scene = sceneOf(b.city, sunAt(45));
        for (const glm::vec3& inside : {glm::vec3(6, 4.5F, 1.5F), glm::vec3(0.3F, 0.3F, 0.3F),
                                        glm::vec3(11.8F, 8.8F, 9.8F), glm::vec3(6, 24, 5)}) {
            EXPECT_TRUE(scene->insideSolid(inside)) << inside.x << " " << inside.y;
        }
        for (const glm::vec3& street :
             {glm::vec3(6, 14.5F, 1.5F), glm::vec3(-0.3F, 4, 1.5F), glm::vec3(6, 9.2F, 0.5F),
              glm::vec3(6, 19.9F, 9.0F), glm::vec3(6, 4, 10.3F)}) {
            EXPECT_FALSE(scene->insideSolid(street)) << street.x << " " << street.y;
        }
    }
}

TEST(InsideSolid, AShellWithoutFloorOrWithAWallMissingIsStillSolid) {
    SceneBuilder open;
    open.box(open.object("a", CityObjectType::Building), {0, 0, 0}, {12, 9, 10}, kNone, false,
             false);
    EXPECT_TRUE(sceneOf(open.city, sunAt(45))->insideSolid({6, 4, 1.5F}));

    SceneBuilder missing = open;
    missing.city.triangles.erase(missing.city.triangles.begin(),
                                 missing.city.triangles.begin() + 2);  // the southern wall
    EXPECT_TRUE(sceneOf(missing.city, sunAt(45))->insideSolid({6, 6, 5}));
    EXPECT_FALSE(sceneOf(missing.city, sunAt(45))->insideSolid({6, -2, 1.5F}));
}

TEST(InsideSolid, TerracedHousesWithCommonWallsAreSolid) {
    SceneBuilder b;
    for (int i = 0; i < 5; ++i) {
        const float x = 6.0F * float(i);
        b.box(b.object("house" + std::to_string(i), CityObjectType::Building), {x, 0, 0},
              {x + 6, 9, 10});
    }
    const auto scene = sceneOf(b.city, sunAt(45));
    for (int i = 0; i < 5; ++i) {
        EXPECT_TRUE(scene->insideSolid({6.0F * float(i) + 2.2F, 4.4F, 1.5F})) << i;
    }
}

TEST(InsideSolid, ABuildingMadeOfPartsThatShareNoWallIsSolid) {
    SceneBuilder b;
    const auto root = b.object("root", CityObjectType::Building);
    for (const float x : {0.0F, 6.0F}) {
        const auto part = b.object("part", CityObjectType::BuildingPart);
        b.city.objects[part].parent = root;
        b.box(part, {x, 0, 0}, {x + 6, 9, 8 + x});
    }
    EXPECT_TRUE(sceneOf(b.city, sunAt(45))->insideSolid({3, 4, 2}));
    EXPECT_TRUE(sceneOf(b.city, sunAt(45))->insideSolid({9, 4, 2}));
}

TEST(InsideSolid, UnderABridgeInAnArcadeAndUnderATreeOneIsFree) {
    SceneBuilder b;
    b.box(b.object("bridge", CityObjectType::Bridge), {-20, -4, 5}, {20, 4, 6});
    // A building on two rows of piers, open below 4 m.
    const auto house = b.object("arcade", CityObjectType::Building);
    b.box(house, {0, 20, 4}, {20, 32, 14});
    for (float x = 0.0F; x < 20.0F; x += 5.0F) {
        b.box(house, {x, 20, 0}, {x + 0.6F, 20.6F, 4});
        b.box(house, {x, 31.4F, 0}, {x + 0.6F, 32, 4});
    }
    b.box(b.object("tree", CityObjectType::SolitaryVegetation), {40, 0, 2}, {44, 4, 8});
    const auto scene = sceneOf(b.city, sunAt(45));
    EXPECT_FALSE(scene->insideSolid({0, 0, 1.5F}));
    EXPECT_TRUE(scene->insideSolid({0, 0, 5.5F})) << "in the deck";
    EXPECT_FALSE(scene->insideSolid({8, 26, 1.5F}));
    EXPECT_TRUE(scene->insideSolid({8, 26, 9.0F}));
    EXPECT_FALSE(scene->insideSolid({42, 2, 1.0F}));
    EXPECT_FALSE(scene->insideSolid({42, 2, 5.0F})) << "a crown is no wall";
}

}  // namespace
}  // namespace reflet::testing
