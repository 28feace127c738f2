// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemVertexTracer.h"
#include "core/reconstruction/SurfaceRefinement.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reflet {
namespace {

/// What a REM sees of the plane {x : normal·x = height}, and of nothing else.
ReferenceEnvironmentMap seePlane(const glm::dvec3& center, const glm::dvec3& normal, double height,
                                 int resolution) {
    ReferenceEnvironmentMap rem =
        test::plainMap("r", center, resolution, glm::vec3(1.0f), kInfinity);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < resolution; ++row) {
            for (int column = 0; column < resolution; ++column) {
                const glm::dvec3 d = texelDirection(resolution, face, column, row);
                const double t = (height - glm::dot(normal, center)) / glm::dot(normal, d);
                if (t > 0.0)
                    rem.distance.at(face, column, row) = float(t * glm::length(d));
            }
        }
    }
    return rem;
}

TEST(SurfaceRefinement, FindsThePlaneThatTheRemSawWhateverItsOrientation) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int found = 0;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
        const glm::dvec3 center(unit(random), unit(random), unit(random));
        const ReferenceEnvironmentMap rem = seePlane(center, normal, 12.0, 64);
        const glm::dvec3 position = center + glm::dvec3(unit(random), unit(random), unit(random));
        const glm::dvec3 spread(unit(random), unit(random), unit(random));
        const glm::dvec3 towards = glm::normalize(normal + 0.5 * spread);
        const double truth = (12.0 - glm::dot(normal, position)) / glm::dot(normal, towards);
        const std::optional<double> t =
            refineOnSurface(rem, {position, towards}, truth + 0.8 * unit(random), 2.0);
        ASSERT_TRUE(t);
        ASSERT_NEAR(*t, truth, 2e-3);
        ++found;
    }
    EXPECT_EQ(found, 300);
}

TEST(SurfaceRefinement, LeavesAHitAloneThatIsTooFarFromTheSurface) {
    const ReferenceEnvironmentMap rem = seePlane({0, 0, 0}, {1, 0, 0}, 10.0, 64);
    const Ray ray{{1, 1, 0}, {1, 0.1, 0.2}};
    EXPECT_NEAR(refineOnSurface(rem, ray, 8.0, 2.0).value_or(0.0), 9.0, 1e-5);
    EXPECT_FALSE(refineOnSurface(rem, ray, 6.0, 2.0));
}

TEST(SurfaceRefinement, LeavesAHitAloneWhereTheRemSeesAnEdgeOrSky) {
    ReferenceEnvironmentMap rem = test::plainMap("r", {0, 0, 0}, 64, glm::vec3(1.0f), kInfinity);
    const Ray ray{{0.5, 0.0, 0.0}, {1, 0.001, 0.001}};
    EXPECT_FALSE(refineOnSurface(rem, ray, 9.0, 5.0)) << "sky";
    rem = seePlane({0, 0, 0}, {1, 0, 0}, 10.0, 64);
    EXPECT_TRUE(refineOnSurface(rem, ray, 9.0, 5.0));
    for (int row = 0; row < 64; ++row) {
        for (int column = 0; column < 32; ++column)
            rem.distance.at(0, column, row) = kInfinity;
    }
    EXPECT_FALSE(refineOnSurface(rem, ray, 9.0, 5.0)) << "half sky";
    rem.distance.at(0, 31, 31) = 7.0f;
    EXPECT_FALSE(refineOnSurface(rem, ray, 9.0, 5.0)) << "an edge";
}

TEST(SurfaceRefinement, MovesTheHitsOnTheStairsOfAnObliqueWallOntoTheWall) {
    // The wall y = 12 + x/2, of which the heightfield knows the cells whose centres lie behind it.
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-0.5, 1.0, 0.0));
    const double height = glm::dot(normal, glm::dvec3(0, 12, 0));
    test::BoxCity city(-30, -30, 60, 60, 1.0);
    for (int i = -20; i < 20; ++i)
        city.addBox(i, 12.0 + 0.5 * (i + 0.5), i + 1, 30, 40.0f);
    const HeightfieldTracer tracer(city.heightfield());
    const RemSet rems{seePlane({-3, -1, 2}, normal, height, 128)};
    const ReconstructionInput input{&tracer, rems, 200.0};
    const glm::dvec3 position(1.0, 0.5, 2.0);
    const RemCandidates candidates{Weighting::BySight, {{0, 1.0}}};
    const MemVertexTracer asHit(input, candidates, position, false);
    const MemVertexTracer refined(input, candidates, position, true);
    double worstBefore = 0.0;
    double worstAfter = 0.0;
    for (int row = 0; row < 40; ++row) {
        for (int column = 0; column < 40; ++column) {
            const glm::dvec3 d = faceDirection(2, {-0.6 + 0.03 * column, 0.01 + 0.015 * row});
            const MemVertex before = asHit.trace(d);
            const MemVertex after = refined.trace(d);
            ASSERT_TRUE(before.validA);
            worstBefore = std::max(worstBefore, std::abs(glm::dot(normal, before.point) - height));
            worstAfter = std::max(worstAfter, std::abs(glm::dot(normal, after.point) - height));
            ASSERT_NEAR(after.distance, glm::length(after.point - position), 1e-9);
            ASSERT_NEAR(after.inverseDepth * (after.point.y - position.y), 1.0, 1e-9);
        }
    }
    EXPECT_GT(worstBefore, 0.3);
    EXPECT_LT(worstAfter, 0.002);
}

}  // namespace
}  // namespace reflet
