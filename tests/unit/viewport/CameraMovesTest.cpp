// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/camera/CameraMoves.h"
#include "widgets/viewport/camera/ViewGeometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace reflet {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Cameras at all heights and distances that a city may have.
class RandomViews {
public:
    ViewGeometry next() {
        Camera camera;
        const double scale = std::pow(10.0, uniform(-1.0, 3.5));
        camera.position = {uniform(-500, 500), uniform(-500, 500), uniform(1, 300)};
        camera.target = camera.position + scale * directionOf({uniform(-4, 4), uniform(-1.5, 1.5)});
        camera.verticalFov = uniform(0.2, 1.6);
        return {camera, uniform(200, 3000), uniform(200, 2000)};
    }
    glm::dvec2 pixelIn(const ViewGeometry& view) {
        return {uniform(0, view.width()), uniform(0, view.height())};
    }
    double uniform(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(m_random);
    }

private:
    std::mt19937 m_random{7};
};

void expectSound(const Camera& camera) {
    for (const glm::dvec3& v : {camera.position, camera.target}) {
        ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
    }
    EXPECT_GT(glm::distance(camera.position, camera.target), 0.0);
    EXPECT_LE(std::abs(headingOf(camera).pitch), kSteepest + 1e-9);
    EXPECT_NEAR(ViewGeometry(camera, 4, 3).right().z, 0.0, 1e-12) << "the camera rolls";
}

TEST(ViewGeometry, ProjectsAPointOfAPixelsRayBackToThatPixel) {
    RandomViews random;
    for (int k = 0; k < 2000; ++k) {
        const ViewGeometry view = random.next();
        const glm::dvec2 pixel = random.pixelIn(view);
        const Ray ray = view.ray(pixel);
        const ProjectedPoint back = view.project(ray.at(random.uniform(0.5, 2000)));
        ASSERT_GT(back.depth, 0.0);
        EXPECT_LT(glm::distance(back.pixel, pixel), 1e-6);
        EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-12);
    }
}

TEST(ViewGeometry, PutsNorthAboveAndEastOnTheRightOfAViewFromTheSouth) {
    const ViewGeometry view({{0, -10, 10}, {0, 0, 0}, 0.9}, 800, 600);
    EXPECT_LT(view.project({0, 5, 0}).pixel.y, 300.0);
    EXPECT_GT(view.project({5, 0, 0}).pixel.x, 400.0);
    EXPECT_NEAR(view.project({0, 0, 0}).pixel.x, 400.0, 1e-9);
    EXPECT_NEAR(view.project({0, 0, 0}).pixel.y, 300.0, 1e-9);
}

TEST(ViewGeometry, SaysThatAPointBehindTheCameraHasNoDepth) {
    const ViewGeometry view({{0, 0, 10}, {0, 10, 10}, 0.9}, 800, 600);
    EXPECT_LE(view.project({0, -5, 10}).depth, 0.0);
    EXPECT_LE(view.project({0, 0, 10}).depth, 0.0);
}

TEST(ViewGeometry, GivesNumbersForCamerasThatAreNone) {
    for (const Camera& camera :
         {Camera{{0, 0, 0}, {0, 0, 0}, 0.9}, Camera{{0, 0, 0}, {0, 0, 5}, 0.9},
          Camera{{kNan, 0, 0}, {0, kNan, 5}, kNan},
          Camera{{0, 0, 0}, {1e300, 1e300, 1e300}, 9.0}}) {
        const ViewGeometry view(camera, 0, 0);
        expectSound(view.camera());
        const glm::dvec3 direction = view.ray({3, 4}).direction;
        EXPECT_TRUE(std::isfinite(direction.x + direction.y + direction.z));
    }
}

TEST(CameraMoves, KeepThePivotOfAnOrbitWhereItIsInThePicture) {
    RandomViews random;
    for (int k = 0; k < 2000; ++k) {
        const ViewGeometry view = random.next();
        const glm::dvec2 pixel = random.pixelIn(view);
        const glm::dvec3 pivot = view.ray(pixel).at(random.uniform(1, 500));
        const Camera after =
            orbited(view.camera(), pivot, random.uniform(-3, 3), random.uniform(-3, 3));
        expectSound(after);
        const ViewGeometry now(after, view.width(), view.height());
        EXPECT_LT(glm::distance(now.project(pivot).pixel, pixel), 1e-5);
        EXPECT_NEAR(glm::distance(after.position, pivot),
                    glm::distance(view.camera().position, pivot), 1e-6);
    }
}

TEST(CameraMoves, TurnTheSceneWithTheMouse) {
    // Dragging to the right turns the near side of the scene to the right: the camera, south of the
    // pivot, goes west.
    const Camera before{{0, -10, 5}, {0, 0, 0}, 0.9};
    EXPECT_LT(orbited(before, {0, 0, 0}, -0.3, 0.0).position.x, 0.0);
    EXPECT_GT(orbited(before, {0, 0, 0}, 0.0, -0.3).position.z, 5.0);
}

TEST(CameraMoves, KeepTheGrabbedPointUnderTheMouseWhilePanning) {
    RandomViews random;
    int level = 0;
    for (int k = 0; k < 2000; ++k) {
        const ViewGeometry view = random.next();
        const glm::dvec2 from = random.pixelIn(view);
        const Ray ray = view.ray(from);
        if (ray.direction.z > -0.2) {
            continue;  // towards the ground: what one grabs
        }
        const glm::dvec3 grabbed = ray.at(-view.camera().position.z / ray.direction.z);
        const glm::dvec2 to = from + glm::dvec2(random.uniform(-60, 60), random.uniform(-40, 40));
        if (view.ray(to).direction.z > -0.1) {
            continue;
        }
        const Camera after = panned(view, grabbed, to);
        expectSound(after);
        const ViewGeometry now(after, view.width(), view.height());
        EXPECT_LT(glm::distance(now.project(grabbed).pixel, to), 1e-5);
        EXPECT_NEAR(after.position.z, view.camera().position.z, 1e-6);
        ++level;
    }
    EXPECT_GT(level, 300);
}

TEST(CameraMoves, DoNotThrowTheCameraAwayWhenAPanReachesTheHorizon) {
    const ViewGeometry view({{0, 0, 2}, {0, 10, 1}, 0.9}, 800, 600);
    const glm::dvec3 grabbed{0, 20, 0};
    for (double y = 0.0; y < 600.0; y += 7.0) {
        const Camera after = panned(view, grabbed, {400, y});
        expectSound(after);
        EXPECT_LT(glm::distance(after.position, view.camera().position), 120.0);
    }
}

TEST(CameraMoves, ZoomTowardsThePointUnderTheMouseWithoutMovingItInThePicture) {
    RandomViews random;
    for (int k = 0; k < 2000; ++k) {
        const ViewGeometry view = random.next();
        const glm::dvec2 pixel = random.pixelIn(view);
        const double distance = random.uniform(1, 500);
        const glm::dvec3 point = view.ray(pixel).at(distance);
        const Camera after = zoomed(view.camera(), point, random.uniform(0.5, 1.9));
        expectSound(after);
        const ViewGeometry now(after, view.width(), view.height());
        EXPECT_LT(glm::distance(now.project(point).pixel, pixel), 1e-4);
        EXPECT_NEAR(glm::dot(now.forward(), view.forward()), 1.0, 1e-12);
    }
}

TEST(CameraMoves, NeverZoomThroughThePoint) {
    Camera camera{{0, -30, 20}, {0, 0, 0}, 0.9};
    for (int k = 0; k < 200; ++k) {
        camera = zoomed(camera, {0, 0, 0}, 0.5);
        expectSound(camera);
    }
    EXPECT_NEAR(glm::length(camera.position), 0.2, 1e-9);
    for (int k = 0; k < 200; ++k) {
        camera = zoomed(camera, {0, 0, 0}, 2.0);
    }
    EXPECT_NEAR(glm::length(camera.position), 20'000.0, 1e-6);
}

TEST(CameraMoves, FrameABoxSoThatAllOfItIsInThePicture) {
    RandomViews random;
    for (int k = 0; k < 500; ++k) {
        const ViewGeometry view = random.next();
        Box box;
        box.add({random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(0, 9)});
        box.add(box.min + glm::dvec3(random.uniform(0, 80), random.uniform(0, 80), 12.0));
        const Camera after = framed(view, box);
        expectSound(after);
        const ViewGeometry now(after, view.width(), view.height());
        for (int corner = 0; corner < 8; ++corner) {
            const ProjectedPoint at = now.project({(corner & 1) != 0 ? box.max.x : box.min.x,
                                                   (corner & 2) != 0 ? box.max.y : box.min.y,
                                                   (corner & 4) != 0 ? box.max.z : box.min.z});
            ASSERT_GT(at.depth, 0.0);
            EXPECT_TRUE(at.pixel.x >= 0 && at.pixel.x <= view.width() && at.pixel.y >= 0 &&
                        at.pixel.y <= view.height());
        }
    }
}

TEST(CameraMoves, LeaveTheCameraAloneWhenThereIsNothingToFrame) {
    const ViewGeometry view({{0, -10, 10}, {0, 0, 0}, 0.9}, 800, 600);
    EXPECT_EQ(framed(view, Box()).position, view.camera().position);
}

TEST(CameraMoves, FlyFromOneCameraToAnotherTheShorterWayRound) {
    const Camera from{{0, 0, 10}, glm::dvec3(0, 0, 10) + directionOf({3.0, 0.0}), 0.9};
    const Camera to{{10, 0, 10}, glm::dvec3(10, 0, 10) + directionOf({-3.0, 0.0}), 0.5};
    EXPECT_EQ(between(from, to, 0.0).position, from.position);
    EXPECT_EQ(between(from, to, 1.0).target, to.target);
    for (double t = 0.0; t <= 1.0; t += 0.05) {
        const Camera there = between(from, to, t);
        expectSound(there);
        EXPECT_GT(std::abs(headingOf(there).yaw), 2.99) << "went the long way round";
    }
}

TEST(CameraMoves, StayNoSteeperThanTheSteepestView) {
    Camera camera{{0, -10, 5}, {0, 0, 0}, 0.9};
    for (int k = 0; k < 50; ++k) {
        camera = orbited(camera, {1, 2, 0}, 0.1, -0.2);
        expectSound(camera);
    }
    EXPECT_NEAR(headingOf(camera).pitch, -kSteepest, 1e-9);
    camera = seenFrom(camera, {0.5 * kPi, -0.5 * kPi});
    expectSound(camera);
}

TEST(CameraMoves, RaiseACameraThatWouldBeBelowTheGround) {
    const Camera camera{{0, 0, -3}, {0, 10, -3}, 0.9};
    EXPECT_DOUBLE_EQ(raised(camera, 1.0, 0.5).position.z, 1.5);
    EXPECT_DOUBLE_EQ(raised(camera, 1.0, 0.5).target.z, 1.5);
    EXPECT_DOUBLE_EQ(raised(camera, -9.0, 0.5).position.z, -3.0);
    EXPECT_DOUBLE_EQ(raised(camera, kNan, 0.5).position.z, -3.0);
}

}  // namespace
}  // namespace reflet
