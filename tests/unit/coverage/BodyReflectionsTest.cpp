// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/BodyReflections.h"
#include "core/coverage/QuasiRandom.h"
#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace reflet {
namespace {

BodyReflections reflectionsOf(const char* name) {
    const auto vehicle = builtInVehicle(name);
    EXPECT_TRUE(vehicle);
    return BodyReflections(*vehicle);
}

/// A mirror ball shows a far viewer all directions alike: a patch of its picture between the
/// angles θ and θ + dθ of the normal has the area sin θ cos θ dθ and mirrors the angles 2θ.
TEST(BodyReflectionsTest, AMirrorBallShowsAllDirectionsAlike) {
    const BodyReflections ball = reflectionsOf("sphere");
    const glm::dvec3 eye(61.0, 0.0, ball.centerHeight());
    const std::vector<double> weights = ball.weights(eye);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-9);
    constexpr int n = BodyReflections::kResolution;
    // By faces: the six solid angles are the same. Away from the viewer the ball ends in grazing
    // angles, which its facets render coarsely, and mirrors a little more.
    for (int face = 0; face < 6; ++face) {
        double sum = 0.0;
        for (int k = 0; k < n * n; ++k)
            sum += weights[std::size_t(face * n * n + k)];
        EXPECT_NEAR(sum, 1.0 / 6.0, 0.02) << face;
    }
}

TEST(BodyReflectionsTest, DrawsDirectionsByTheirWeights) {
    const BodyReflections car = reflectionsOf("car");
    const glm::dvec3 eye(4.0, 7.0, 1.6);
    const std::vector<double> weights = car.weights(eye);
    constexpr int n = BodyReflections::kResolution;
    std::vector<double> drawn(weights.size(), 0.0);
    const QuasiRandom<2> sequence(3);
    constexpr int count = 200'000;
    for (int i = 0; i < count; ++i) {
        const auto x = sequence.at(std::uint64_t(i));
        const glm::dvec3 direction = car.direction(eye, {x[0], x[1]});
        EXPECT_NEAR(glm::length(direction), 1.0, 1e-9);
        const Texel texel = texelAt(n, direction);
        drawn[std::size_t((texel.face * n + texel.row) * n + texel.column)] += 1.0 / count;
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
        EXPECT_NEAR(drawn[i], weights[i], 2e-4) << i;
}

/// Somebody at the left of a bus looks at its left side, which mirrors what lies to the left.
TEST(BodyReflectionsTest, ASideMirrorsWhatLiesOnTheViewersSide) {
    const BodyReflections bus = reflectionsOf("bus");
    for (const double side : {1.0, -1.0}) {
        const std::vector<double> weights = bus.weights({0.0, 8.0 * side, 1.6});
        double same = 0.0;
        constexpr int n = BodyReflections::kResolution;
        for (int k = 0; k < 6 * n * n; ++k) {
            const glm::dvec3 d = texelDirection(n, k / (n * n), k % n, k / n % n);
            same += d.y * side > 0.0 ? weights[std::size_t(k)] : 0.0;
        }
        // The rest is what the rounded edge of the roof mirrors: the sky beyond it.
        EXPECT_GT(same, 0.75) << side;
    }
}

TEST(QuasiRandomTest, CoversTheSquareBetterThanChance) {
    const QuasiRandom<2> sequence(7);
    constexpr int cells = 32, count = 32 * cells * cells;
    std::vector<int> hits(std::size_t(cells * cells), 0);
    for (int i = 0; i < count; ++i) {
        const auto x = sequence.at(std::uint64_t(i));
        ++hits[std::size_t(int(x[0] * cells) * cells + int(x[1] * cells))];
    }
    double squares = 0.0;
    for (const int h : hits)
        squares += double(h - 32) * double(h - 32);
    // By chance the variance would be 32.
    EXPECT_LT(squares / (cells * cells), 6.0);
    EXPECT_NE(QuasiRandom<2>(8).at(0), sequence.at(0)) << "another seed, another shift";
    EXPECT_EQ(QuasiRandom<2>(7).at(5), sequence.at(5));
}

}  // namespace
}  // namespace reflet
