// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"
#include "core/traffic/Squeeze.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

Vehicle mirror() {
    Vehicle vehicle;
    VehicleMaterial chrome;
    chrome.metallic = 1.0F;
    vehicle.materials = {chrome, VehicleMaterial{}};
    return vehicle;
}

VehicleBody ball(float radius) {
    constexpr int kRings = 128, kSegments = 256;
    VehicleBody body;
    for (int i = 0; i <= kRings; ++i) {
        for (int j = 0; j <= kSegments; ++j) {
            const double a = kPi * i / kRings, b = 2.0 * kPi * j / kSegments;
            const glm::vec3 n(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
            body.normals.push_back(n);
            body.vertices.push_back(radius * n);
        }
    }
    for (unsigned i = 0; i < kRings; ++i) {
        for (unsigned j = 0; j < kSegments; ++j) {
            const unsigned at = i * (kSegments + 1) + j, below = at + kSegments + 1;
            body.triangles.push_back({at, below, below + 1});
            body.triangles.push_back({at, below + 1, at + 1});
        }
    }
    body.triangleMaterial.assign(body.triangles.size(), 0);
    return body;
}

/// One side of `length` by `height`, seen from +y.
VehicleBody plate(float length, float height) {
    VehicleBody body;
    body.vertices = {{0, 0, 0}, {0, 0, height}, {length, 0, height}, {length, 0, 0}};
    body.normals.assign(4, {0.0F, 1.0F, 0.0F});
    body.triangles = {{0, 1, 2}, {0, 2, 3}};
    body.triangleMaterial = {0, 0};
    return body;
}

TEST(Squeeze, OfASphereIsThatOfTheWholeMapInItsOutline) {
    // 6 N² texels lie in π/4 p² pixels, evenly: N / p · sqrt(24 / π) along an edge.
    const double expected = std::sqrt(24.0 / kPi);
    EXPECT_NEAR(squeezeOf(mirror(), ball(1.0F)), expected, 0.03 * expected);
    EXPECT_NEAR(squeezeOf(mirror(), ball(7.0F)), expected, 0.03 * expected) << "at any size";
}

TEST(Squeeze, OfAFlatSideIsNothing) {
    EXPECT_EQ(squeezeOf(mirror(), plate(8.0F, 3.0F)), 0.0);
}

TEST(Squeeze, IsTheMedianOverWhatIsSeenAndReflects) {
    // A ball in front of a much larger plate, and one that is not shiny.
    VehicleBody both = plate(40.0F, 30.0F);
    const auto first = unsigned(both.vertices.size());
    const VehicleBody round = ball(1.0F);
    both.vertices.insert(both.vertices.end(), round.vertices.begin(), round.vertices.end());
    both.normals.insert(both.normals.end(), round.normals.begin(), round.normals.end());
    for (const glm::uvec3& t : round.triangles)
        both.triangles.push_back(t + first);
    both.triangleMaterial.resize(both.triangles.size(), 0);
    EXPECT_EQ(squeezeOf(mirror(), both), 0.0);
    both.triangleMaterial[0] = both.triangleMaterial[1] = 1;  // the plate is dull
    EXPECT_GT(squeezeOf(mirror(), both), 2.0);
}

TEST(Squeeze, OfVehiclesLiesBetweenThePlateAndTheSphere) {
    for (const char* name : {"car", "bus", "tram"}) {
        const auto vehicle = builtInVehicle(name);
        ASSERT_TRUE(vehicle);
        const double squeeze = squeezeOf(*vehicle, vehicle->bodies.front());
        EXPECT_GE(squeeze, 0.0) << name;
        EXPECT_LT(squeeze, std::sqrt(24.0 / kPi)) << name;
        RecordProperty(name, std::to_string(squeeze));
    }
    const auto sphere = builtInVehicle("sphere");
    EXPECT_NEAR(squeezeOf(*sphere, sphere->bodies.front()), std::sqrt(24.0 / kPi), 0.15);
}

TEST(Squeeze, OfWhatReflectsNothingOrIsBrokenIsNothing) {
    Vehicle matt;
    matt.materials = {VehicleMaterial{}};
    EXPECT_EQ(squeezeOf(matt, ball(1.0F)), 0.0);
    EXPECT_EQ(squeezeOf(mirror(), VehicleBody{}), 0.0);
    VehicleBody broken = plate(1.0F, 1.0F);
    broken.triangles.push_back({0, 1, 99});
    broken.triangleMaterial = {0};
    EXPECT_EQ(squeezeOf(mirror(), broken), 0.0);
}

}  // namespace
}  // namespace reflet
