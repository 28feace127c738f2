// SPDX-License-Identifier: GPL-3.0-or-later
// Rays that start beside a map's centre, against rooms whose hits are known in closed form.
#include "core/environment/CubeDirection.h"
#include "core/environment/DistanceImpostor.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace reflet {
namespace {

constexpr int kResolution = 128;
constexpr double kTexel = 2.0 / kResolution;  // radians, at the middle of a face

CubeMap<float> distancesOf(const std::function<double(const glm::dvec3&)>& along) {
    CubeMap<float> map(kResolution);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < kResolution; ++row) {
            for (int column = 0; column < kResolution; ++column)
                map.at(face, column, row) =
                    float(along(glm::normalize(texelDirection(kResolution, face, column, row))));
        }
    }
    return map;
}

/// Metres to the walls of a box around the centre, from within.
double toWall(const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 low(-9.0, -4.0, -1.6), high(30.0, 7.0, 12.0);
    double t = 1e300;
    for (int k = 0; k < 3; ++k) {
        if (direction[k] != 0.0)
            t = std::min(t, ((direction[k] > 0.0 ? high : low)[k] - origin[k]) / direction[k]);
    }
    return t;
}

glm::dvec3 unit(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(DistanceImpostor, FindsTheWallsOfARoomFromAllOverAVehicle) {
    const CubeMap<float> map = distancesOf([](const auto& d) { return toWall({}, d); });
    std::mt19937 random(7);
    std::uniform_real_distribution<double> x(-6.0, 6.0), y(-1.3, 1.3), z(-1.3, 1.5);
    int astray = 0;
    constexpr int kRays = 20'000;
    for (int i = 0; i < kRays; ++i) {
        const glm::dvec3 origin(x(random), y(random), z(random));
        const glm::dvec3 direction = unit(random);
        const glm::dvec3 hit = origin + toWall(origin, direction) * direction;
        const glm::vec3 found = directionOfHit(map, glm::vec3(origin), glm::vec3(direction));
        // By direction alone the same ray is up to a right angle astray.
        astray += angleBetween(hit, glm::dvec3(found)) > kTexel ? 1 : 0;
    }
    // Corners of the room are rounded by a texel, and grazing rays cross it there.
    EXPECT_LT(astray, kRays / 50);
}

TEST(DistanceImpostor, IsExactOnAPlane) {
    // The ground 1.6 m below; sky above.
    const CubeMap<float> map =
        distancesOf([](const auto& d) { return d.z < 0.0 ? -1.6 / d.z : 1e300; });
    for (const glm::dvec3 origin : {glm::dvec3(3.0, 0.5, -0.4), {-10.0, 1.2, 1.0}}) {
        for (const glm::dvec3 to : {glm::dvec3(1.0, 2.0, -1.6), {-4.0, 6.0, -1.6}}) {
            const glm::vec3 found =
                directionOfHit(map, glm::vec3(origin), glm::vec3(glm::normalize(to - origin)));
            EXPECT_LT(angleBetween(to, glm::dvec3(found)), 0.05 * kTexel);
        }
        const glm::vec3 up = glm::normalize(glm::vec3(0.3F, 0.2F, 0.9F));
        EXPECT_EQ(directionOfHit(map, glm::vec3(origin), up), up);
    }
}

TEST(DistanceImpostor, FromTheCentreAndUnderAnOpenSkyIsTheDirectionItself) {
    const CubeMap<float> sky(8, std::numeric_limits<float>::infinity());
    const CubeMap<float> near(8, 2.0F);
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 direction(unit(random));
        EXPECT_EQ(directionOfHit(near, glm::vec3(0.0F), direction), direction);
        EXPECT_EQ(directionOfHit(sky, glm::vec3(unit(random)), direction), direction);
    }
}

TEST(DistanceImpostor, OnASphereMeetsIt) {
    const CubeMap<float> map(16, 10.0F);
    std::mt19937 random(5);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 origin = 6.0 * unit(random);
        const glm::dvec3 direction = unit(random);
        const double b = glm::dot(origin, direction);
        const glm::dvec3 hit = origin + (-b + std::sqrt(b * b + 64.0)) * direction;
        const glm::vec3 found = directionOfHit(map, glm::vec3(origin), glm::vec3(direction));
        EXPECT_LT(angleBetween(hit, glm::dvec3(found)), 1e-3);
    }
}

TEST(DistanceImpostor, WhatStartsBehindTheSurfaceEndsThere) {
    const CubeMap<float> map(8, 2.0F);
    const glm::vec3 outside(3.0F, 0.0F, 0.0F);
    EXPECT_EQ(directionOfHit(map, outside, {0.0F, 1.0F, 0.0F}), outside);
}

}  // namespace
}  // namespace reflet
