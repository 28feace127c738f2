// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"
#include "core/traffic/Vehicle.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

const Vehicle& vehicleNamed(const char* name) {
    static const Vehicle tram = builtInVehicle("tram").value();
    static const Vehicle bus = builtInVehicle("bus").value();
    static const Vehicle car = builtInVehicle("car").value();
    return name[0] == 't' ? tram : name[0] == 'b' ? bus : car;
}

Route circle(double radius, double turn) {
    std::vector<glm::dvec3> points;
    const int count = int(std::ceil(turn * radius / 0.05));
    for (int i = 0; i <= count; ++i) {
        const double a = turn * i / count;
        points.emplace_back(radius * std::cos(a), radius * std::sin(a), 2.0);
    }
    return Route(points);
}

glm::dvec3 pivot(const VehicleBody& body, const RigidTransform& pose, double side) {
    return pose * glm::dvec3(body.pivotMiddle + side * 0.5 * body.pivotSpan, 0.0, 0.0);
}

double distanceToRoute(const Route& route, const glm::dvec3& p) {
    double nearest = 1e300;
    for (std::size_t i = 1; i < route.points().size(); ++i) {
        const glm::dvec3 a = route.points()[i - 1];
        const glm::dvec3 d = route.points()[i] - a;
        const double t = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(p, a + t * d));
    }
    return nearest;
}

TEST(BodyPoses, PutBodiesAtTheirOffsetsOnAStraightRoute) {
    const Vehicle& tram = vehicleNamed("tram");
    const Route route({{0, 0, 3}, {0, 200, 3}});
    const auto poses = bodyPoses(tram, route, 100.0);
    ASSERT_EQ(poses.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(
            glm::distance(poses[i].translation, glm::dvec3(0, 100.0 + tram.bodies[i].offset, 3)),
            0.0, 1e-6);
        EXPECT_NEAR(poses[i].direction({1, 0, 0}).y, 1.0, 1e-9);
        EXPECT_NEAR(poses[i].direction({0, 1, 0}).x, -1.0, 1e-9);  // left of north is west
        EXPECT_NEAR(poses[i].direction({0, 0, 1}).z, 1.0, 1e-9);
    }
}

TEST(BodyPoses, KeepBothPivotsOfEachBodyOnACircle) {
    for (const char* name : {"tram", "bus", "car"}) {
        const Vehicle& vehicle = vehicleNamed(name);
        const Route route = circle(25.0, 4.5);
        const auto poses = bodyPoses(vehicle, route, 55.0);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            for (const double side : {-1.0, 1.0}) {
                const glm::dvec3 p = pivot(vehicle.bodies[i], poses[i], side);
                EXPECT_NEAR(std::hypot(p.x, p.y), 25.0, 2e-5) << name << i;
                EXPECT_NEAR(p.z, 2.0, 1e-9);
            }
        }
    }
}

TEST(BodyPoses, BendTheTramSoThatNeighboursMeetAtTheirJoints) {
    const Vehicle& tram = vehicleNamed("tram");
    const Route route = Route({{0, 0, 0}, {80, 0, 0}, {80, 80, 0}, {160, 80, 0}}).smoothed(22.0);
    int bends = 0;
    for (double s = 20.0; s < route.length() - 20.0; s += 1.7) {
        const auto poses = bodyPoses(tram, route, s);
        for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
            const glm::dvec3 ahead = pivot(tram.bodies[i], poses[i], i == 4 ? 0.0 : -1.0);
            const glm::dvec3 behind = pivot(tram.bodies[i + 1], poses[i + 1], 1.0);
            EXPECT_LT(glm::distance(ahead, behind), 1e-6) << i << " at " << s;
            EXPECT_LT(distanceToRoute(route, ahead), 1e-6);
            bends += glm::dot(poses[i].direction({1, 0, 0}), poses[i + 1].direction({1, 0, 0})) <
                     std::cos(0.1);
        }
    }
    EXPECT_GT(bends, 20);
}

TEST(BodyPoses, MoveSmoothlyWithTheDistance) {
    const Route route = Route({{0, 0, 0}, {60, 0, 1}, {75, 50, 1}, {140, 60, 4}}).smoothed(20.0);
    for (const char* name : {"tram", "bus", "car"}) {
        const Vehicle& vehicle = vehicleNamed(name);
        auto last = bodyPoses(vehicle, route, 20.0);
        for (double s = 20.02; s < route.length() - 18.0; s += 0.02) {
            const auto next = bodyPoses(vehicle, route, s);
            for (std::size_t i = 0; i < next.size(); ++i) {
                ASSERT_LT(glm::distance(last[i].translation, next[i].translation), 0.03)
                    << name << " at " << s;
                ASSERT_GT(glm::dot(last[i].direction({1, 0, 0}), next[i].direction({1, 0, 0})),
                          std::cos(0.01));
            }
            last = next;
        }
    }
}

TEST(BodyPoses, StayRigidAndUprightOnASlope) {
    const Route route({{0, 0, 0}, {100, 0, 10}});
    for (const RigidTransform& pose : bodyPoses(vehicleNamed("bus"), route, 50.0)) {
        const glm::dvec3 x = pose.direction({1, 0, 0});
        const glm::dvec3 y = pose.direction({0, 1, 0});
        const glm::dvec3 z = pose.direction({0, 0, 1});
        EXPECT_NEAR(x.z, 10.0 / std::hypot(100.0, 10.0), 1e-9);
        EXPECT_NEAR(y.z, 0.0, 1e-12);
        EXPECT_NEAR(glm::dot(glm::cross(x, y), z), 1.0, 1e-12);
        EXPECT_NEAR(pose.translation.z, 0.1 * pose.translation.x, 1e-9);
    }
}

TEST(BodyPoses, CoupleTheHalvesOfTheBusRigidly) {
    const Vehicle& bus = vehicleNamed("bus");
    ASSERT_EQ(bus.bodies.size(), 2U);
    const auto poses = bodyPoses(bus, circle(20.0, 4.0), 40.0);
    EXPECT_EQ(poses[0].rotation, poses[1].rotation);
    // The point where they were cut is the same in both.
    const double cut = bus.bodies[0].offset;
    EXPECT_NEAR(glm::distance(poses[0] * glm::dvec3(-cut, 0, 0),
                              poses[1] * glm::dvec3(-bus.bodies[1].offset, 0, 0)),
                0.0, 1e-9);
}

TEST(BodyPoses, ClampTheVehicleToTheRoute) {
    const Vehicle& tram = vehicleNamed("tram");
    const Route route({{0, 0, 0}, {300, 0, 0}});
    for (const double s : {-50.0, 0.0, 300.0, 1e6}) {
        const auto poses = bodyPoses(tram, route, s);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            for (const glm::vec3& v : tram.bodies[i].vertices) {
                const double x = (poses[i] * glm::dvec3(v)).x;
                ASSERT_GE(x, -1e-4);
                ASSERT_LE(x, 300.0 + 1e-4);
            }
        }
    }
}

TEST(BodyPoses, LetALongVehicleOverhangAShortRouteStraight) {
    const Vehicle& tram = vehicleNamed("tram");
    for (const RigidTransform& pose : bodyPoses(tram, Route({{0, 0, 0}, {10, 0, 0}}), 3.0)) {
        EXPECT_NEAR(pose.direction({1, 0, 0}).x, 1.0, 1e-9);
        EXPECT_NEAR(pose.translation.y, 0.0, 1e-9);
    }
}

}  // namespace
}  // namespace reflet
