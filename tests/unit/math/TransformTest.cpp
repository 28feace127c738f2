// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Transform.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reflet {
namespace {

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance) {
    EXPECT_NEAR(actual.x, expected.x, tolerance);
    EXPECT_NEAR(actual.y, expected.y, tolerance);
    EXPECT_NEAR(actual.z, expected.z, tolerance);
}

RigidTransform randomTransform(std::mt19937_64& random) {
    std::uniform_real_distribution<double> angle(-kPi, kPi);
    std::uniform_real_distribution<double> shift(-1000.0, 1000.0);
    const auto about = [&](int axis) {
        // A turn about z, its axes renamed: any of the three.
        const glm::dmat3 turn = RigidTransform::atHeading(glm::dvec3(0.0), angle(random)).rotation;
        glm::dmat3 renamed(0.0);
        for (int column = 0; column < 3; ++column) {
            for (int row = 0; row < 3; ++row)
                renamed[(column + axis) % 3][(row + axis) % 3] = turn[column][row];
        }
        return renamed;
    };
    return {about(0) * about(1) * about(2), {shift(random), shift(random), shift(random)}};
}

TEST(RigidTransform, ChangesNothingByDefault) {
    const glm::dvec3 p(3.0, -4.0, 5.0);
    EXPECT_EQ(RigidTransform() * p, p);
    EXPECT_EQ(RigidTransform().direction(p), p);
}

TEST(RigidTransform, TurnsTheFrontCounterClockwiseFromEast) {
    const glm::dvec3 stop(10.0, 20.0, 30.0);
    const glm::dvec3 front(5.0, 0.0, 0.0);
    const glm::dvec3 left(0.0, 1.0, 0.0);
    expectNear(RigidTransform::atHeading(stop, 0.0) * front, {15.0, 20.0, 30.0}, 1e-12);
    expectNear(RigidTransform::atHeading(stop, kPi / 2) * front, {10.0, 25.0, 30.0}, 1e-12);
    expectNear(RigidTransform::atHeading(stop, kPi) * front, {5.0, 20.0, 30.0}, 1e-12);
    expectNear(RigidTransform::atHeading(stop, kPi / 2) * left, {9.0, 20.0, 30.0}, 1e-12);
    const double half = std::sqrt(0.5);
    expectNear(RigidTransform::atHeading(stop, kPi / 4).direction({1.0, 0.0, 0.0}),
               {half, half, 0.0}, 1e-12);
}

TEST(RigidTransform, LeavesDirectionsUnshifted) {
    const RigidTransform world_from_car = RigidTransform::atHeading({100.0, 200.0, 0.0}, 0.0);
    EXPECT_EQ(world_from_car.direction({0.0, 0.0, 1.0}), glm::dvec3(0.0, 0.0, 1.0));
}

TEST(RigidTransform, ChainsFromTheRightToTheLeft) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 100; ++i) {
        const RigidTransform world_from_tram = randomTransform(random);
        const RigidTransform tram_from_door = randomTransform(random);
        const glm::dvec3 handle(0.3, -0.2, 1.1);
        expectNear((world_from_tram * tram_from_door) * handle,
                   world_from_tram * (tram_from_door * handle), 1e-9);
    }
}

TEST(RigidTransform, ItsInverseUndoesIt) {
    std::mt19937_64 random(4);
    for (int i = 0; i < 100; ++i) {
        const RigidTransform world_from_car = randomTransform(random);
        const glm::dvec3 p(1.0, 2.0, 3.0);
        expectNear(world_from_car.inverse() * (world_from_car * p), p, 1e-9);
        expectNear((world_from_car * world_from_car.inverse()) * p, p, 1e-9);
        expectNear(world_from_car.inverse().direction(world_from_car.direction(p)), p, 1e-12);
    }
}

TEST(RigidTransform, KeepsLengthsAndHandedness) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 100; ++i) {
        const RigidTransform t = randomTransform(random);
        EXPECT_NEAR(glm::length(t.direction({1.0, 2.0, 2.0})), 3.0, 1e-12);
        EXPECT_NEAR(glm::determinant(t.rotation), 1.0, 1e-12);
    }
}

}  // namespace
}  // namespace reflet
