// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"
#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemVertexTracer.h"
#include "core/reconstruction/Reconstruction.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace reflet {
namespace {

const test::BoxCity& city() {
    static const test::BoxCity instance = test::streetCity();
    return instance;
}
const HeightfieldTracer& tracer() {
    static const HeightfieldTracer instance(city().heightfield());
    return instance;
}

float largestDifference(const CubeMap<glm::vec3>& a, const CubeMap<glm::vec3>& b) {
    float largest = 0.0f;
    for (std::size_t i = 0; i < a.texels().size(); ++i) {
        const glm::vec3 d = glm::abs(a.texels()[i] - b.texels()[i]);
        largest = std::max({largest, d.x, d.y, d.z});
    }
    return largest;
}

TEST(Reconstruction, ReproducesARemTexelForTexelAtItsOwnCentre) {
    const glm::dvec3 center(3.2, -1.4, 1.8);
    ReferenceEnvironmentMap rem = city().see("only", center, 128, 1);
    std::mt19937 random(1);  // noise in every texel, so that no neighbour can stand in for another
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    for (glm::vec3& texel : rem.radiance.texels())
        texel = {value(random), value(random), value(random)};
    const RemSet rems{rem};
    for (const Interpolation interpolation : {Interpolation::Exact, Interpolation::AsInPaper}) {
        MemSettings settings;
        settings.interpolation = interpolation;
        if (interpolation == Interpolation::AsInPaper)
            settings.depthRatio = 0.0;
        const LocalEnvironmentMap map = reconstructMem({&tracer(), rems, 300.0}, center, settings);
        EXPECT_EQ(map.center, center);
        EXPECT_LT(largestDifference(map.radiance, rems[0].radiance), 1e-5f);
    }
}

TEST(Reconstruction, SeesTheDistancesOfARemAtItsOwnCentre) {
    const glm::dvec3 center(3.2, -1.4, 1.8);
    const RemSet rems{city().see("only", center, 128, 1)};
    const LocalEnvironmentMap map = reconstructMem({&tracer(), rems, 300.0}, center, MemSettings{});
    std::size_t same = 0;
    for (std::size_t i = 0; i < map.distance.texels().size(); ++i) {
        const float truth = rems[0].distance.texels()[i];
        const float found = map.distance.texels()[i];
        same += found == truth || std::abs(found - truth) < 0.01f * truth ? 1 : 0;
    }
    EXPECT_GT(double(same), 0.95 * double(map.distance.texels().size()));
    EXPECT_EQ(map.statistics.uncovered, 0u);
    EXPECT_EQ(*std::max_element(map.uncovered.texels().begin(), map.uncovered.texels().end()), 0);
}

TEST(Reconstruction, LooksTheNearerOfTwoRemsUpAtItsOwnTexelsFromItsOwnCentre) {
    // A tells where it was looked up and marks its weight in the third channel; B is black.
    const glm::dvec3 center(3.2, -1.4, 1.8);
    RemSet rems{test::plainMap("b", {18.2, -1.4, 1.8}, 128, glm::vec3(0.0f), kInfinity),
                test::coordinateMap("a", center, 128, kInfinity)};
    const LocalEnvironmentMap map = reconstructMem({&tracer(), rems, 300.0}, center, MemSettings{});
    int checked = 0;
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < 128; ++row) {
            for (int column = 0; column < 128; ++column) {
                const glm::vec3 seen = map.radiance.at(face, column, row);
                if (seen.z < 0.01f)
                    continue;
                ASSERT_NEAR(seen.x / seen.z, texelCoordinate(128, column), 2e-5);
                ASSERT_NEAR(seen.y / seen.z, texelCoordinate(128, row), 2e-5);
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 60000);
}

TEST(Reconstruction, LeavesEverythingBlackAndUncoveredWithoutAnyRem) {
    const LocalEnvironmentMap map =
        reconstructMem({&tracer(), {}, 300.0}, {0, 0, 2}, MemSettings{});
    for (const glm::vec3& texel : map.radiance.texels())
        ASSERT_EQ(texel, glm::vec3(0.0f));
    for (const unsigned char texel : map.uncovered.texels())
        ASSERT_EQ(texel, 1);
    EXPECT_GT(map.statistics.vertices, 600u);
    EXPECT_EQ(map.statistics.uncovered, map.statistics.vertices);
    EXPECT_LT(*std::min_element(map.distance.texels().begin(), map.distance.texels().end()), 2.5f);
}

TEST(Reconstruction, GivesAllWeightToASingleRem) {
    const RemSet rems{test::plainMap("r", {40, 0, 2}, 8, {0.5f, 0.25f, 1.0f}, 1e6f)};
    const LocalEnvironmentMap map =
        reconstructMem({&tracer(), rems, 300.0}, {0, 0, 2}, MemSettings{});
    for (const glm::vec3& texel : map.radiance.texels())
        ASSERT_LT(glm::length(texel - rems[0].radiance.at(0, 0, 0)), 1e-6f);
    EXPECT_GT(map.statistics.uncovered, 0u)
        << "sky is not valid where the REM sees something at 1000 km";
    EXPECT_LT(map.statistics.uncovered, map.statistics.vertices);
}

TEST(Reconstruction, UsesTheFirstOfTwoCoincidentRemsAloneInThePaper) {
    const RemSet rems{test::plainMap("b", {5, 0, 2}, 8, glm::vec3(1.0f), kInfinity),
                      test::plainMap("a", {5, 0, 2}, 8, glm::vec3(0.25f), kInfinity)};
    MemSettings settings;
    settings.weighting = Weighting::AsInPaper;
    const LocalEnvironmentMap map = reconstructMem({&tracer(), rems, 300.0}, {0, 0, 2}, settings);
    for (const glm::vec3& texel : map.radiance.texels())
        ASSERT_NEAR(texel.x, 0.25f, 1e-6f);
}

TEST(Reconstruction, ShowsOnlySkyFromFarOutsideTheGrid) {
    const RemSet rems{test::plainMap("r", {0, 0, 2}, 8, glm::vec3(0.5f), kInfinity)};
    const LocalEnvironmentMap map =
        reconstructMem({&tracer(), rems, 300.0}, {50000, 23456, 7000}, MemSettings{});
    EXPECT_EQ(map.statistics.quads, 600u);
    for (const float distance : map.distance.texels())
        ASSERT_EQ(distance, kInfinity);
    for (const glm::vec3& texel : map.radiance.texels())
        ASSERT_LT(glm::length(texel - glm::vec3(0.5f)), 1e-6f);
}

TEST(Reconstruction, StaysFiniteInsideASolid) {
    const RemSet rems{city().see("r", {0, 0, 2}, 16, 1), city().see("s", {9, 0, 2}, 16, 1)};
    for (const glm::dvec3& inside :
         {glm::dvec3(-75, 15, 3), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -5)}) {
        for (const Interpolation interpolation : {Interpolation::Exact, Interpolation::AsInPaper}) {
            MemSettings settings;
            settings.interpolation = interpolation;
            settings.resolution = 32;
            const LocalEnvironmentMap map =
                reconstructMem({&tracer(), rems, 300.0}, inside, settings);
            for (const glm::vec3& texel : map.radiance.texels()) {
                ASSERT_TRUE(std::isfinite(texel.x) && texel.x >= 0.0f && texel.x <= 1.0f);
            }
            for (const float distance : map.distance.texels())
                ASSERT_FALSE(std::isnan(distance));
        }
    }
}

TEST(Reconstruction, CountsWhatItsFacesHold) {
    const RemSet rems{city().see("r", {0, 0, 2}, 32, 1), city().see("s", {15, 0, 2}, 32, 1)};
    const ReconstructionInput input{&tracer(), rems, 300.0};
    const glm::dvec3 position(6, 1, 1.5);
    const LocalEnvironmentMap map = reconstructMem(input, position, MemSettings{});
    std::size_t quads = 0, vertices = 0, uncovered = 0;
    for (int face = 0; face < 6; ++face) {
        const MemFace mesh = buildMemFace(input, candidateRems(rems, position, MemSettings{}),
                                          position, face, MemSettings{});
        quads += mesh.quads.size();
        vertices += mesh.vertices.size();
        uncovered += std::size_t(std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                                               [](const MemVertex& v) { return v.uncovered; }));
    }
    EXPECT_EQ(map.statistics.quads, quads);
    EXPECT_EQ(map.statistics.vertices, vertices);
    EXPECT_EQ(map.statistics.rays, vertices);
    EXPECT_EQ(map.statistics.uncovered, uncovered);
    EXPECT_GT(uncovered, 0u);
    EXPECT_GT(map.statistics.milliseconds, 0.0);
}

bool sameBits(const LocalEnvironmentMap& a, const LocalEnvironmentMap& b) {
    const auto equal = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
    };
    return equal(a.radiance.texels(), b.radiance.texels()) &&
           equal(a.distance.texels(), b.distance.texels()) &&
           equal(a.uncovered.texels(), b.uncovered.texels());
}

TEST(Reconstruction, GivesTheSameBitsForAnyNumberOfThreads) {
    const RemSet rems{city().see("r", {0, 0, 2}, 32, 1), city().see("s", {15, 0, 2}, 32, 1)};
    const ReconstructionInput input{&tracer(), rems, 300.0};
    std::vector<LocalEnvironmentMap> maps;
    for (const int threads : {1, 2, 5, 0}) {
        setThreadLimit(threads);
        maps.push_back(reconstructMem(input, {6, 1, 1.5}, MemSettings{}));
    }
    for (const LocalEnvironmentMap& map : maps) {
        EXPECT_TRUE(sameBits(map, maps.front()));
        EXPECT_EQ(map.statistics.vertices, maps.front().statistics.vertices);
    }
}

TEST(Dense, GivesEachTexelTheRayAndTheRemsOfItsOwn) {
    const RemSet rems{city().see("r", {0, 0, 2}, 64, 1), city().see("s", {15, 0, 2}, 64, 1),
                      city().see("t", {5, 3, 2}, 64, 1)};
    const ReconstructionInput input{&tracer(), rems, 300.0};
    const glm::dvec3 position(6, 1, 1.5);
    for (const Weighting weighting : {Weighting::BySight, Weighting::AsInPaper}) {
        MemSettings settings;
        settings.resolution = 48;
        settings.weighting = weighting;
        const LocalEnvironmentMap map = reconstructDense(input, position, settings);
        const RemCandidates candidates = candidateRems(rems, position, settings);
        const MemVertexTracer single(input, candidates, position, settings.refineHits);
        std::size_t uncovered = 0;
        for (int face = 0; face < 6; ++face) {
            for (int row = 0; row < 48; ++row) {
                for (int column = 0; column < 48; ++column) {
                    const MemVertex vertex = single.trace(texelDirection(48, face, column, row));
                    glm::vec3 expected(0.0f);
                    for (const auto& [rem, weight] : {std::pair(vertex.a, vertex.weightA),
                                                      std::pair(vertex.b, vertex.weightB)}) {
                        if (rem < 0)
                            continue;
                        const ReferenceEnvironmentMap& map2 =
                            rems[candidates.rems[std::size_t(rem)].rem];
                        const glm::dvec3 towards =
                            vertex.sky ? vertex.direction : vertex.point - map2.center;
                        expected += float(weight) * sampleBilinear(map2.radiance, towards);
                    }
                    ASSERT_LT(glm::distance(map.radiance.at(face, column, row), expected), 1e-3f);
                    ASSERT_EQ(map.distance.at(face, column, row),
                              vertex.sky ? kInfinity : float(vertex.distance));
                    ASSERT_EQ(map.uncovered.at(face, column, row), vertex.uncovered ? 1 : 0);
                    uncovered += vertex.uncovered ? 1 : 0;
                }
            }
        }
        EXPECT_EQ(map.statistics.uncovered, uncovered);
        EXPECT_EQ(map.statistics.rays, 6u * 48u * 48u);
        EXPECT_EQ(map.statistics.quads, 0u);
    }
}

TEST(Dense, IsTheFullMeshOfSingleTexels) {
    const RemSet rems{city().see("r", {0, 0, 2}, 64, 1), city().see("s", {15, 0, 2}, 64, 1)};
    const ReconstructionInput input{&tracer(), rems, 300.0};
    MemSettings settings;
    settings.resolution = 40;
    settings.depthRatio = 0.0;
    settings.meshSize = 40;
    const LocalEnvironmentMap full = reconstructMem(input, {6, 1, 1.5}, settings);
    const LocalEnvironmentMap dense = reconstructDense(input, {6, 1, 1.5}, settings);
    EXPECT_LT(largestDifference(full.radiance, dense.radiance), 1e-6f);
    EXPECT_EQ(full.distance.texels(), dense.distance.texels());
}

TEST(Dense, GivesTheSameBitsForAnyNumberOfThreads) {
    const RemSet rems{city().see("r", {0, 0, 2}, 32, 1), city().see("s", {15, 0, 2}, 32, 1)};
    const ReconstructionInput input{&tracer(), rems, 300.0};
    std::vector<LocalEnvironmentMap> maps;
    for (const int threads : {1, 2, 5, 0}) {
        setThreadLimit(threads);
        maps.push_back(reconstructDense(input, {6, 1, 1.5}, MemSettings{}));
    }
    for (const LocalEnvironmentMap& map : maps)
        EXPECT_TRUE(sameBits(map, maps.front()));
}

TEST(Baselines, LookTheNearestRemUpAsIfAtInfinity) {
    const RemSet rems{test::coordinateMap("r", {0, 0, 2}, 64, 8.0f),
                      test::plainMap("s", {15, 0, 2}, 64, glm::vec3(9.0f), 8.0f)};
    const LocalEnvironmentMap map = reconstructNearest({&tracer(), rems, 300.0}, {6, 1, 1.5}, 64);
    EXPECT_LT(largestDifference(map.radiance, rems[0].radiance), 1e-5f);
    EXPECT_EQ(map.distance.texels(), rems[0].distance.texels());
    EXPECT_EQ(map.statistics.rays, 0u);
}

TEST(Baselines, BlendTwoRemsWithTheWeightsOfThePosition) {
    const RemSet rems{test::plainMap("r", {0, 0, 2}, 64, glm::vec3(1.0f), 8.0f),
                      test::plainMap("s", {15, 0, 2}, 64, glm::vec3(0.0f), 8.0f)};
    const LocalEnvironmentMap map = reconstructBlend({&tracer(), rems, 300.0}, {6, 4, 1.5}, 32);
    for (const glm::vec3& texel : map.radiance.texels())
        ASSERT_NEAR(texel.x, 0.6f, 1e-6f);
    const LocalEnvironmentMap beyond = reconstructBlend({&tracer(), rems, 300.0}, {-6, 4, 1.5}, 32);
    for (const glm::vec3& texel : beyond.radiance.texels())
        ASSERT_NEAR(texel.x, 1.0f, 1e-6f);
}

TEST(Baselines, AreBlackAndUncoveredWithoutAnyRem) {
    for (const LocalEnvironmentMap& map :
         {reconstructNearest({&tracer(), {}, 300.0}, {0, 0, 2}, 8),
          reconstructBlend({&tracer(), {}, 300.0}, {0, 0, 2}, 8)}) {
        ASSERT_EQ(map.radiance.texels().size(), 384u);
        for (const glm::vec3& texel : map.radiance.texels())
            ASSERT_EQ(texel, glm::vec3(0.0f));
        for (const unsigned char texel : map.uncovered.texels())
            ASSERT_EQ(texel, 1);
    }
}

}  // namespace
}  // namespace reflet
