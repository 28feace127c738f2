// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/BoxCity.h"
#include "widgets/viewport/camera/CameraMoves.h"
#include "widgets/viewport/camera/Walker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

using test::BoxCity;

Camera lookingNorth(double x, double y) {
    return {{x, y, kEyeHeight}, {x, y + 10.0, kEyeHeight}, 0.9};
}

Camera afterWalking(const Ground& ground, Camera camera, const WalkInput& input, double seconds) {
    for (double t = 0.0; t < seconds; t += 0.016) {
        camera = Walker::walked(ground, camera, input, 0.016);
        EXPECT_FALSE(ground.isSolid(camera.position.x, camera.position.y));
    }
    return camera;
}

TEST(Walker, GoesWhereItLooksAtThreeMetresASecond) {
    const Ground ground(BoxCity::make());
    const Camera after = afterWalking(ground, lookingNorth(0, 0), {.ahead = 1.0}, 2.0);
    EXPECT_NEAR(after.position.x, 0.0, 1e-9);
    EXPECT_NEAR(after.position.y, 6.0, 0.1);
    EXPECT_NEAR(after.position.z, kEyeHeight, 1e-6);
}

TEST(Walker, StepsAsideToItsRight) {
    const Ground ground(BoxCity::make());
    const Camera after = afterWalking(ground, lookingNorth(0, 0), {.sideways = 1.0}, 1.0);
    EXPECT_GT(after.position.x, 2.5);
    EXPECT_NEAR(after.position.y, 0.0, 1e-9);
}

TEST(Walker, DoesNotWalkFasterDiagonally) {
    const Ground ground(BoxCity::make());
    const Camera after =
        afterWalking(ground, lookingNorth(0, 0), {.ahead = 1.0, .sideways = 1.0}, 1.0);
    EXPECT_LT(std::hypot(after.position.x, after.position.y), 3.2);
}

TEST(Walker, DoesNotEnterAHouse) {
    const Ground ground(BoxCity::make());
    const Camera after =
        afterWalking(ground, lookingNorth(20, 0), {.ahead = 1.0, .fast = true}, 5.0);
    EXPECT_LT(after.position.y, 10.0);
    EXPECT_GT(after.position.y, 9.0);
}

TEST(Walker, SlidesAlongAWallThatItMeetsAtAnAngle) {
    const Ground ground(BoxCity::make());
    Camera camera = lookingNorth(12, 8);
    camera.target = camera.position + 10.0 * directionOf({0.25 * kPi, 0.0});
    const Camera after = afterWalking(ground, camera, {.ahead = 1.0}, 3.0);
    EXPECT_GT(after.position.x, 16.0);
    EXPECT_LT(after.position.y, 10.0);
}

TEST(Walker, DoesNotLeaveTheCity) {
    const Ground ground(BoxCity::make());
    const Camera after =
        afterWalking(ground, lookingNorth(-50, 50), {.ahead = 1.0, .fast = true}, 5.0);
    EXPECT_LT(after.position.y, BoxCity::kHalf);
}

TEST(Walker, FollowsTheGroundUpASlope) {
    const Ground ground(BoxCity::make([](double, double y) { return 0.2 * y; }));
    Camera camera =
        afterWalking(ground, Walker::standing(ground, lookingNorth(0, 0)), {.ahead = 1.0}, 2.0);
    camera = afterWalking(ground, camera, {}, 2.0);
    EXPECT_GT(camera.position.y, 5.0);
    EXPECT_NEAR(camera.position.z,
                ground.heightAt(camera.position.x, camera.position.y) + kEyeHeight, 0.01);
}

TEST(Walker, DoesNotClimbACliff) {
    const Ground ground(BoxCity::make([](double, double y) { return y > 5.0 ? 9.0 : 0.0; }));
    const Camera after = afterWalking(ground, lookingNorth(0, 0), {.ahead = 1.0}, 4.0);
    EXPECT_LT(after.position.y, 5.5);
    EXPECT_LT(after.position.z, 4.0);
}

TEST(Walker, StandsUpBesideTheHouseInWhichTheCameraWas) {
    const Ground ground(BoxCity::make());
    const Camera camera = Walker::standing(ground, {{20, 12, 5}, {20, 30, 5}, 0.9});
    EXPECT_TRUE(Walker::isFree(ground, glm::dvec2(camera.position)));
    EXPECT_NEAR(camera.position.z, kEyeHeight, 1e-6);
    EXPECT_LT(glm::distance(glm::dvec2(camera.position), glm::dvec2(20, 12)), 5.0);
}

TEST(Walker, ComesDownFromAboveAndLooksAhead) {
    const Ground ground(BoxCity::make());
    const Camera camera = Walker::standing(ground, {{-5, 3, 80}, {-5, 4, 0}, 0.9});
    EXPECT_NEAR(camera.position.x, -5.0, 1e-9);
    EXPECT_NEAR(camera.position.z, kEyeHeight, 1e-6);
    EXPECT_GT(headingOf(camera).pitch, -0.3);
}

TEST(Walker, TakesALongPauseForAShortStep) {
    const Ground ground(BoxCity::make());
    const Camera after = Walker::walked(ground, lookingNorth(0, 0), {.ahead = 1.0}, 60.0);
    EXPECT_LT(after.position.y, 1.0);
}

}  // namespace
}  // namespace reflet
