// SPDX-License-Identifier: GPL-3.0-or-later
// Weighting::BySight: which REMs serve a point, and that nothing jumps while a vehicle drives.
#include "BoxCity.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemVertexTracer.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace reflet {
namespace {

/// REMs every `spacing` metres along x at y = 0, z = 2, that see everything.
RemSet row(int count, double spacing) {
    RemSet rems;
    for (int i = 0; i < count; ++i) {
        rems.add(test::plainMap("r" + std::to_string(i), {spacing * i, 0.0, 2.0}, 4,
                                glm::vec3(0.5F), kInfinity));
    }
    return rems;
}

/// Weights of REMs, by their index in the set.
std::map<std::size_t, double> weightsOf(const MemVertex& vertex, const RemCandidates& candidates) {
    std::map<std::size_t, double> weights;
    if (vertex.a >= 0)
        weights[candidates.rems[std::size_t(vertex.a)].rem] += vertex.weightA;
    if (vertex.b >= 0)
        weights[candidates.rems[std::size_t(vertex.b)].rem] += vertex.weightB;
    return weights;
}

TEST(Candidates, AreTheNearestFirst) {
    const RemSet rems = row(20, 10.0);
    MemSettings settings;
    settings.remsPerVehicle = 5;
    const RemCandidates found = candidateRems(rems, {52.0, 1.0, 2.0}, settings);
    ASSERT_GE(found.rems.size(), 4U);
    EXPECT_LE(found.rems.size(), 5U);
    for (std::size_t i = 0; i < found.rems.size(); ++i)
        EXPECT_EQ(found.rems[i].rem, (std::array<std::size_t, 5>{5, 6, 4, 7, 3})[i]);
    EXPECT_EQ(found.rems.front().presence, 1.0);
}

TEST(Candidates, HaveAllTheirPresenceWhereNoneIsLeftOut) {
    for (const RemCandidate& candidate : candidateRems(row(8, 30.0), {3.0, 9.0, 1.0}, {}).rems)
        EXPECT_EQ(candidate.presence, 1.0);
    EXPECT_TRUE(candidateRems({}, {0, 0, 0}, {}).rems.empty());
}

TEST(Candidates, KeepOneWhenAllStandAtTheSameDistance) {
    RemSet rems;
    for (int i = 0; i < 12; ++i) {
        const double turn = 2.0 * kPi * i / 12.0;
        rems.add(test::plainMap("r", {10.0 * std::cos(turn), 10.0 * std::sin(turn), 0.0}, 4,
                                glm::vec3(0.5F), kInfinity));
    }
    EXPECT_FALSE(candidateRems(rems, {0, 0, 0}, {}).rems.empty());
}

TEST(Candidates, ComeAndGoWithoutAJump) {
    const RemSet rems = row(40, 7.0);
    MemSettings settings;
    settings.remsPerVehicle = 4;
    std::map<std::size_t, double> before;
    constexpr double kStep = 0.01;
    double largest = 0.0;
    for (double x = 60.0; x < 120.0; x += kStep) {
        std::map<std::size_t, double> presence;
        for (const RemCandidate& c : candidateRems(rems, {x, 1.5, 1.5}, settings).rems)
            presence[c.rem] = c.presence;
        if (!before.empty()) {
            for (std::size_t i = 0; i < rems.size(); ++i)
                largest = std::max(largest, std::abs(presence[i] - before[i]));
        }
        before = presence;
    }
    // Two distances of at least 14 m change by a step each, over a quarter of the larger.
    EXPECT_LT(largest, 2.5 * kStep / (0.25 * 14.0));
}

TEST(WeightingBySight, IsContinuousAlongADriveForEveryDirection) {
    // All that stands is one long wall; nothing hides it, so that only the weights can jump.
    test::BoxCity city(-20, -20, 340, 60, 1.0);
    city.addBox(-20, 12, 320, 14, 25.0F);
    const HeightfieldTracer tracer(city.heightfield());
    const RemSet rems = row(40, 8.0);
    const ReconstructionInput input{&tracer, rems, 500.0};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    constexpr double kStep = 0.02;
    for (int i = 0; i < 12; ++i) {
        const glm::dvec3 direction(unit(random), 1.0, 0.4 * unit(random));
        std::map<std::size_t, double> before;
        for (double x = 100.0; x < 130.0; x += kStep) {
            const glm::dvec3 position(x, 2.0, 1.5);
            const RemCandidates candidates = candidateRems(rems, position, {});
            const auto weights = weightsOf(
                MemVertexTracer(input, candidates, position, false).trace(direction), candidates);
            double sum = 0.0;
            for (const auto& [rem, weight] : weights) {
                EXPECT_GE(weight, 0.0);
                sum += weight;
                const double last = before.empty() ? weight : before[rem];
                EXPECT_NEAR(weight, last, 0.03) << "REM " << rem << " at " << x;
            }
            EXPECT_NEAR(sum, 1.0, 1e-12);
            for (const auto& [rem, weight] : before) {
                const bool stays = weights.contains(rem);
                EXPECT_TRUE(stays || weight < 0.03) << "REM " << rem << " left at " << x;
            }
            before = weights;
        }
    }
}

TEST(WeightingBySight, TakesTheRemThatLooksAtThePointMostAsTheVehicleDoes) {
    test::BoxCity city(-20, -20, 140, 60, 1.0);
    city.addBox(-20, 12, 120, 14, 25.0F);
    const HeightfieldTracer tracer(city.heightfield());
    const RemSet rems = row(6, 20.0);
    const glm::dvec3 position(47.0, 0.5, 2.0);
    const RemCandidates candidates = candidateRems(rems, position, {});
    const MemVertex vertex =
        MemVertexTracer({&tracer, rems, 200.0}, candidates, position, false).trace({0.3, 1.0, 0.2});
    const auto weights = weightsOf(vertex, candidates);
    ASSERT_TRUE(weights.contains(2)) << "the REM at 40 m is the nearest in angle";
    EXPECT_GT(weights.at(2), 0.5);
    // The weights by the formula, from the penalties of all that see the wall.
    std::vector<double> penalties;
    for (std::size_t i = 0; i < rems.size(); ++i) {
        const glm::dvec3 u = glm::normalize(vertex.point - position);
        const glm::dvec3 v = glm::normalize(vertex.point - rems[i].center);
        const double farther = glm::distance(vertex.point, rems[i].center) / vertex.distance - 1.0;
        penalties.push_back(glm::length(u - v) + std::max(0.0, farther));
    }
    std::sort(penalties.begin(), penalties.end());
    const double first = 1.0 / penalties[0] - 1.0 / penalties[2];
    const double second = 1.0 / penalties[1] - 1.0 / penalties[2];
    EXPECT_NEAR(weights.at(2), first / (first + second), 1e-4);
}

TEST(WeightingBySight, GoesToAThirdRemWhereThePapersTwoAreBlind) {
    test::BoxCity city(-50, -50, 120, 100, 1.0);
    city.addBox(-50, 20, 60, 22, 20.0F);
    city.addBox(-12, 6, 12, 8, 20.0F);  // hides the wall behind it from A and B, and not from C
    const HeightfieldTracer tracer(city.heightfield());
    const RemSet rems{city.see("A", {-4, 0, 2}, 128, 1), city.see("B", {4, 0, 2}, 128, 1),
                      city.see("C", {0, 14, 2}, 128, 1)};
    const ReconstructionInput input{&tracer, rems, 300.0};
    const glm::dvec3 position(1.0, 12.0, 2.0);
    MemSettings settings;
    settings.weighting = Weighting::AsInPaper;
    RemSet two;
    two.add(rems.pointers()[0]);
    two.add(rems.pointers()[1]);
    const glm::dvec3 towardsWall(-0.2, 1.0, 0.1);
    EXPECT_TRUE(MemVertexTracer({&tracer, two, 300.0}, candidateRems(two, position, settings),
                                position, false)
                    .trace(towardsWall)
                    .uncovered);
    const RemCandidates candidates = candidateRems(rems, position, {});
    const MemVertex vertex = MemVertexTracer(input, candidates, position, false).trace(towardsWall);
    EXPECT_FALSE(vertex.uncovered);
    EXPECT_EQ(weightsOf(vertex, candidates).at(2), 1.0);
}

TEST(WeightingBySight, FallsBackOnTheRemThatSeesNearestToThePoint) {
    // Behind a tower, no REM sees the wall; B looks farther past the tower's side than A.
    const HeightfieldTracer tracer([] {
        test::BoxCity city(-50, -50, 100, 100, 1.0);
        city.addBox(-50, 20, 50, 22, 20.0F);
        return city.heightfield();
    }());
    const RemSet rems{test::plainMap("A", {-5, 0, 2}, 8, glm::vec3(0.1F), 8.0F),
                      test::plainMap("B", {5, 0, 2}, 8, glm::vec3(0.9F), 15.0F)};
    const glm::dvec3 position(-4.0, 0.0, 2.0);
    const RemCandidates candidates = candidateRems(rems, position, {});
    const MemVertex vertex =
        MemVertexTracer({&tracer, rems, 300.0}, candidates, position, true).trace({0.0, 1.0, 0.1});
    EXPECT_TRUE(vertex.uncovered);
    EXPECT_FALSE(vertex.validA || vertex.validB);
    EXPECT_EQ(weightsOf(vertex, candidates).at(1), 1.0);
}

TEST(TexelSources, TellWhatTheTexelsAreMadeOf) {
    const test::BoxCity city = test::streetCity();
    const HeightfieldTracer tracer(city.heightfield());
    const RemSet rems{city.see("a", {-6.5, -1.0, 2.0}, 32, 1),
                      city.see("b", {8.5, -1.0, 2.0}, 32, 1),
                      city.see("c", {1.0, -3.0, 2.0}, 32, 1)};
    MemSettings settings;
    settings.resolution = 32;
    TexelSources sources;
    const LocalEnvironmentMap map =
        reconstructMem({&tracer, rems, 300.0}, {0.5, -1.5, 1.7}, settings, &sources);
    ASSERT_EQ(sources.resolution(), 32);
    std::size_t whole = 0;
    for (std::size_t i = 0; i < sources.texels().size(); ++i) {
        const auto& [first, second] = sources.texels()[i];
        ASSERT_GE(first.rem, 0);
        ASSERT_GE(first.weight, second.weight);
        if (first.weight + second.weight < 0.99999F)
            continue;  // a third one shares in it
        glm::vec3 expected(0.0F);
        for (const TexelSource& source : {first, second}) {
            if (source.rem >= 0)
                expected += source.weight * sampleBilinear(rems[std::size_t(source.rem)].radiance,
                                                           glm::dvec3(source.lookup));
        }
        ASSERT_LT(glm::distance(expected, map.radiance.texels()[i]), 1e-3F);
        ++whole;
    }
    EXPECT_GT(whole, sources.texels().size() * 9 / 10);
}

TEST(TexelSources, OfTheBaselinesLookInTheTexelsOwnDirection) {
    const RemSet rems = row(2, 10.0);
    const ReconstructionInput input{nullptr, rems, 100.0};
    TexelSources sources;
    static_cast<void>(reconstructBlend(input, {7.0, 0.0, 2.0}, 4, &sources));
    const auto& [first, second] = sources.at(2, 1, 3);
    EXPECT_EQ(first.rem, 1);
    EXPECT_NEAR(first.weight, 0.7F, 1e-6F);
    EXPECT_EQ(second.rem, 0);
    EXPECT_EQ(first.lookup, glm::vec3(texelDirection(4, 2, 1, 3)));
    static_cast<void>(reconstructNearest(input, {7.0, 0.0, 2.0}, 4, &sources));
    EXPECT_EQ(sources.at(0, 0, 0)[0].weight, 1.0F);
    EXPECT_EQ(sources.at(0, 0, 0)[1].rem, -1);
}

}  // namespace
}  // namespace reflet
