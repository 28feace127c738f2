// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rendering/CameraRays.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

Camera eastwards() {
    Camera camera;
    camera.position = {100, 200, 10};
    camera.target = {110, 200, 10};
    camera.verticalFov = 2.0 * std::atan(0.5);  // half the height is seen at distance 1
    return camera;
}

TEST(CameraRays, PutTheTargetInTheMiddleOfThePicture) {
    const auto p = CameraRays(eastwards(), 640, 360).project({110, 200, 10});
    ASSERT_TRUE(p.has_value());
    EXPECT_NEAR(p->x, 320.0, 1e-9);
    EXPECT_NEAR(p->y, 180.0, 1e-9);
}

TEST(CameraRays, HaveNorthOnTheLeftWhenLookingEastAndTheSkyAbove) {
    const CameraRays rays(eastwards(), 640, 360);
    // At 10 m depth the picture is 10 m high: 36 pixels a metre.
    const auto north = rays.project({110, 202, 10});
    EXPECT_NEAR(north->x, 320.0 - 72.0, 1e-9);
    EXPECT_NEAR(north->y, 180.0, 1e-9);
    const auto above = rays.project({110, 200, 13});
    EXPECT_NEAR(above->x, 320.0, 1e-9);
    EXPECT_NEAR(above->y, 180.0 - 108.0, 1e-9);
    EXPECT_FALSE(rays.project({90, 200, 10}).has_value());
}

TEST(CameraRays, LeadBackToThePixelThatTheyCameFrom) {
    Camera camera;
    camera.position = {-3, 7, 2};
    camera.target = {40, -11, 9};
    camera.verticalFov = 0.7;
    const CameraRays rays(camera, 1280, 720);
    for (double x = 0.5; x < 1280.0; x += 97.3) {
        for (double y = 0.5; y < 720.0; y += 51.7) {
            const glm::dvec3 d = rays.through(x, y);
            EXPECT_NEAR(glm::length(d), 1.0, 1e-12);
            const auto back = rays.project(camera.position + 25.0 * d);
            ASSERT_TRUE(back.has_value());
            EXPECT_NEAR(back->x, x, 1e-8);
            EXPECT_NEAR(back->y, y, 1e-8);
        }
    }
}

TEST(CameraRays, StayDefinedWhenLookingStraightDown) {
    Camera camera;
    camera.position = {0, 0, 50};
    camera.target = {0, 0, 0};
    const auto east = CameraRays(camera, 100, 100).project({5, 0, 0});
    ASSERT_TRUE(east.has_value());
    EXPECT_GT(east->x, 50.0);
    EXPECT_NEAR(east->y, 50.0, 1e-9);
}

}  // namespace
}  // namespace reflet
