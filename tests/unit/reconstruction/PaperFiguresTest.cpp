// SPDX-License-Identifier: GPL-3.0-or-later
// The configurations of figures 2, 3 and 5 of Meyer & Loscos 2003, computed by hand. A long wall
// runs along x at y = 10; A, P and B stand on a line in front of it:
//
//   y = 10  ═══════════ I ═════════════════════   A = (-5, 0, 2)   P = (0, 0, 2)   B = (15, 0, 2)
//   y = 4..6      ▒▒         ▒▒▒▒                 |AB| = 20
//   y = 0      A    P              B
#include "BoxCity.h"
#include "core/reconstruction/MemVertexTracer.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace reflet {
namespace {

constexpr glm::dvec3 kA(-5, 0, 2);
constexpr glm::dvec3 kB(15, 0, 2);
constexpr glm::dvec3 kP(0, 0, 2);

test::BoxCity wallCity(bool hideFromA, bool hideFromB) {
    test::BoxCity city(-50, -50, 100, 100, 1.0);
    city.addBox(-50, 10, 50, 12, 20.0f);
    if (hideFromA)
        city.addBox(-1, 4, 1, 6, 20.0f);
    if (hideFromB)
        city.addBox(9, 4, 13, 6, 20.0f);
    return city;
}

/// What P meets in a direction, served by A and B with the distance maps that the city gives them.
MemVertex meet(const test::BoxCity& city, const glm::dvec3& direction) {
    const HeightfieldTracer tracer(city.heightfield());
    const RemSet rems{city.see("A", kA, 128, 1), city.see("B", kB, 128, 1)};
    const ReconstructionInput input{&tracer, rems, 1000.0};
    const RemChoice choice = chooseRems(rems, kP);
    EXPECT_EQ(choice.a, 0u);
    EXPECT_EQ(choice.b, 1u);
    MemSettings settings;
    settings.weighting = Weighting::AsInPaper;
    return MemVertexTracer(input, candidateRems(rems, kP, settings), kP, false).trace(direction);
}

TEST(PaperFigures, Figure2PassesTheVectorsFromBothCentresToThePointThatTheRayMeets) {
    const MemVertex vertex = meet(wallCity(false, false), {0.5, 1.0, 0.3});
    ASSERT_FALSE(vertex.sky);
    EXPECT_NEAR(glm::length(vertex.point - glm::dvec3(5, 10, 5)), 0.0, 1e-12);
    EXPECT_NEAR(vertex.distance, std::sqrt(25.0 + 100.0 + 9.0), 1e-12);
    EXPECT_NEAR(vertex.inverseDepth, 0.1, 1e-15);
    for (const glm::dvec3& center : {kA, kB}) {
        const glm::dvec3 coordinates = vertex.direction + vertex.inverseDepth * (kP - center);
        EXPECT_NEAR(glm::length(10.0 * coordinates - (glm::dvec3(5, 10, 5) - center)), 0.0, 1e-12);
    }
}

TEST(PaperFigures, Figure3WeighsByTheProjectionOfThePointOntoTheAxis) {
    const test::BoxCity city = wallCity(false, false);
    const auto expectWeights = [&](const glm::dvec3& direction, double a, double b) {
        const MemVertex vertex = meet(city, direction);
        EXPECT_TRUE(vertex.validA && vertex.validB && !vertex.uncovered);
        EXPECT_NEAR(vertex.weightA, a, 1e-12);
        EXPECT_NEAR(vertex.weightB, b, 1e-12);
    };
    expectWeights({0.5, 1.0, 0.3}, 0.5, 0.5);     // I = (5, 10, 5), D_A = 10/20
    expectWeights({-0.2, 1.0, 0.3}, 0.85, 0.15);  // I = (-2, 10, 5), D_A = 3/20
    expectWeights({0.9, 1.0, 0.0}, 0.3, 0.7);     // I = (9, 10, 2), D_A = 14/20
    expectWeights({-0.9, 1.0, 0.0}, 1.0, 0.0);    // I = (-9, 10, 2) lies behind A
    expectWeights({-0.5, 1.0, 0.0}, 1.0, 0.0);    // I = (-5, 10, 2) lies abreast of A
}

TEST(PaperFigures, Figure3GivesAllToBForAPointBehindB) {
    const MemVertex vertex = meet(wallCity(false, false), {1.0, 0.55, 0.0});  // I = (18.18, 10, 2)
    EXPECT_EQ(vertex.weightA, 0.0);
    EXPECT_EQ(vertex.weightB, 1.0);
}

TEST(PaperFigures, Figure5DismissesARemFromWhichThePointIsHidden) {
    const MemVertex vertex = meet(wallCity(true, false), {0.5, 1.0, 0.3});
    EXPECT_NEAR(glm::length(vertex.point - glm::dvec3(5, 10, 5)), 0.0, 1e-12);
    EXPECT_FALSE(vertex.validA);
    EXPECT_TRUE(vertex.validB);
    EXPECT_FALSE(vertex.uncovered);
    EXPECT_EQ(vertex.weightA, 0.0);
    EXPECT_EQ(vertex.weightB, 1.0);

    const MemVertex other = meet(wallCity(false, true), {0.5, 1.0, 0.3});
    EXPECT_TRUE(other.validA);
    EXPECT_FALSE(other.validB);
    EXPECT_EQ(other.weightA, 1.0);
    EXPECT_EQ(other.weightB, 0.0);
}

TEST(PaperFigures, Figure5FallsBackOnTheHigherWeightBeforeTheTestWhenBothAreBlind) {
    const test::BoxCity city = wallCity(true, true);
    const MemVertex nearerB = meet(city, {0.9, 1.0, 0.3});  // I = (9, 10, 5), s = 0.7
    EXPECT_TRUE(nearerB.uncovered);
    EXPECT_FALSE(nearerB.validA || nearerB.validB);
    EXPECT_EQ(nearerB.weightB, 1.0);
    EXPECT_EQ(nearerB.weightA, 0.0);

    const MemVertex nearerA = meet(city, {0.4, 1.0, 0.3});  // I = (4, 10, 5), s = 0.45
    EXPECT_TRUE(nearerA.uncovered);
    EXPECT_EQ(nearerA.weightA, 1.0);

    const MemVertex halfWay = meet(city, {0.5, 1.0, 0.3});  // s = 0.5: A, the nearer to P
    EXPECT_TRUE(halfWay.uncovered);
    EXPECT_EQ(halfWay.weightA, 1.0);
}

TEST(PaperFigures, WeighsTheSkyByThePositionInsteadOfThePoint) {
    const MemVertex open = meet(wallCity(false, false), {0.1, -0.2, 1.0});
    EXPECT_TRUE(open.sky);
    EXPECT_EQ(open.inverseDepth, 0.0);
    EXPECT_EQ(open.distance, 1000.0);
    EXPECT_TRUE(open.validA && open.validB);
    EXPECT_NEAR(open.weightB, 0.25, 1e-12);  // P lies 5 m of 20 m from A
}

TEST(PaperFigures, DismissesARemThatSeesAWallWhereTheSkyIsLookedFor) {
    // Over the wall from P at y = 0; a tower in front of A hides that part of its sky.
    test::BoxCity city = wallCity(false, false);
    city.addBox(-9, 2, -3, 4, 60.0f);
    const MemVertex vertex = meet(city, {0.1, 0.9, 2.0 * 0.9});
    EXPECT_TRUE(vertex.sky);
    EXPECT_FALSE(vertex.validA);
    EXPECT_TRUE(vertex.validB);
    EXPECT_EQ(vertex.weightB, 1.0);
}

TEST(PaperFigures, ToleratesHalfACellsDiagonal) {
    EXPECT_DOUBLE_EQ(validityTolerance({0, 0, 1.0, 4, 4}), std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(validityTolerance({0, 0, 0.5, 4, 4}), std::sqrt(0.125));
}

}  // namespace
}  // namespace reflet
