// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/BoxCity.h"
#include "widgets/viewport/camera/CameraDriver.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

using test::BoxCity;

class CameraDriverTest : public testing::Test {
protected:
    CameraDriverTest() { driver.setGround(std::make_shared<const Ground>(BoxCity::make())); }
    void run(double seconds) {
        for (double t = 0.0; t < seconds && driver.moving(); t += 0.016) {
            driver.tick(0.016);
        }
    }
    CameraDriver driver;
    const Camera from{{0, -20, 10}, {0, 0, 0}, 0.9};
    const Camera to{{20, -20, 30}, {0, 0, 0}, 0.9};
};

TEST_F(CameraDriverTest, FliesWithinAFifthOfASecond) {
    driver.jump(from);
    driver.fly(to);
    EXPECT_EQ(driver.camera().position, from.position);
    driver.tick(0.1);
    EXPECT_GT(driver.camera().position.x, 5.0);
    EXPECT_LT(driver.camera().position.x, 15.0);
    driver.tick(0.11);
    EXPECT_EQ(driver.camera().position, to.position);
    EXPECT_FALSE(driver.moving());
}

TEST_F(CameraDriverTest, JumpsWithReducedMotion) {
    driver.setReducedMotion(true);
    driver.jump(from);
    driver.fly(to);
    EXPECT_EQ(driver.camera().position, to.position);
    EXPECT_FALSE(driver.moving());
}

TEST_F(CameraDriverTest, StaysWhereAnInterruptedFlightIs) {
    driver.jump(from);
    driver.fly(to);
    driver.tick(0.1);
    const glm::dvec3 there = driver.camera().position;
    driver.interrupt();
    driver.tick(0.1);
    EXPECT_EQ(driver.camera().position, there);
    EXPECT_EQ(driver.destination().position, there);
}

TEST_F(CameraDriverTest, KeepsTheCameraAboveTheGround) {
    driver.jump({{0, 0, -50}, {0, 10, -50}, 0.9});
    EXPECT_GT(driver.camera().position.z, 0.0);
    driver.jump({{0, 0, 5}, {0, 10, 0}, 0.9});
    driver.fly({{0, 5, -9}, {0, 10, -9}, 0.9});
    run(1.0);
    EXPECT_GT(driver.camera().position.z, 0.0);
}

TEST_F(CameraDriverTest, StepsDownToThePavementAndWalks) {
    driver.jump(from);
    driver.setWalking(true);
    run(2.0);
    EXPECT_NEAR(driver.camera().position.z, kEyeHeight, 0.01);
    driver.setInput({.ahead = 1.0});
    EXPECT_TRUE(driver.moving());
    run(1.0);
    EXPECT_GT(driver.camera().position.y, -18.0);
    driver.setInput({});
    run(2.0);
    EXPECT_FALSE(driver.moving());
}

}  // namespace
}  // namespace reflet
