// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemResampler.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace reflet {
namespace {

constexpr int kFace = 0;  // +X
constexpr glm::dvec3 kPosition(100.0, -40.0, 3.0);

LocalEnvironmentMap emptyMap(int resolution) {
    LocalEnvironmentMap map;
    map.radiance = CubeMap<glm::vec3>(resolution, glm::vec3(-1.0f));
    map.distance = CubeMap<float>(resolution, -1.0f);
    map.uncovered = CubeMap<unsigned char>(resolution, 7);
    return map;
}

RemCandidates oneRem() {
    return {Weighting::BySight, {{0, 1.0}}};
}
RemCandidates twoRems() {
    return {Weighting::BySight, {{0, 1.0}, {1, 1.0}}};
}

/// One leaf over [-½, ½]² of the +X face, its corners on the plane {x : n·(x − P) = h}.
struct PlaneLeaf {
    glm::dvec3 normal;
    double height;
    MemFace face;

    [[nodiscard]] double depth(const glm::dvec3& direction) const {
        return height / glm::dot(normal, direction);
    }
};

PlaneLeaf planeLeaf(const glm::dvec3& normal, double height) {
    PlaneLeaf leaf{normal, height, {}};
    const glm::dvec2 corners[4] = {{-0.5, -0.5}, {0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}};
    for (const glm::dvec2& st : corners) {
        MemVertex vertex;
        vertex.direction = faceDirection(kFace, st);
        const double z = leaf.depth(vertex.direction);
        vertex.inverseDepth = 1.0 / z;
        vertex.distance = z * glm::length(vertex.direction);
        vertex.point = kPosition + z * vertex.direction;
        vertex.validA = true;
        vertex.a = 0;
        leaf.face.vertices.push_back(vertex);
    }
    leaf.face.quads.push_back({-0.5, -0.5, 0.5, 0.5, {0, 1, 2, 3}});
    return leaf;
}

struct Errors {
    double largest = 0.0;  ///< of face coordinates, in [-1, 1]²
    double largestDistance = 0.0;
    int texels = 0;
};

/// Random planes seen by a REM somewhere near; the REM's radiance says where it was looked up.
Errors errorsOnRandomPlanes(Interpolation interpolation) {
    constexpr int n = 64;
    const test::BoxCity ground(0, 0, 2, 2, 1.0);
    const HeightfieldTracer tracer(ground.heightfield());
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    Errors errors;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(1.0, 0.8 * unit(random), 0.8 * unit(random)));
        const PlaneLeaf leaf = planeLeaf(normal, 12.0 + 8.0 * unit(random));
        const glm::dvec3 center =
            kPosition + glm::dvec3(4.0 * unit(random), 2.0 * unit(random), unit(random));
        const RemSet rems{test::coordinateMap("r", center, 128, kInfinity)};
        LocalEnvironmentMap map = emptyMap(n);
        const MemResampler resampler({&tracer, rems, 1000.0}, oneRem(), kPosition, interpolation,
                                     map);
        resampler.writeLeaf(kFace, leaf.face, leaf.face.quads.front());
        for (int row = n / 4; row < 3 * n / 4; ++row) {
            for (int column = n / 4; column < 3 * n / 4; ++column) {
                const glm::dvec3 direction = texelDirection(n, kFace, column, row);
                const double z = leaf.depth(direction);
                const FacePoint truth = facePoint(kPosition + z * direction - center);
                if (truth.face != kFace ||
                    std::max(std::abs(truth.st.x), std::abs(truth.st.y)) > 0.98)
                    continue;
                const glm::vec3 seen = map.radiance.at(kFace, column, row);
                EXPECT_NEAR(seen.z, 1.0f, 1e-6f);
                errors.largest = std::max({errors.largest, std::abs(double(seen.x) - truth.st.x),
                                           std::abs(double(seen.y) - truth.st.y)});
                const double distance = z * glm::length(direction);
                errors.largestDistance = std::max(
                    errors.largestDistance,
                    std::abs(double(map.distance.at(kFace, column, row)) / distance - 1.0));
                ++errors.texels;
            }
        }
    }
    return errors;
}

TEST(MemResampler, InterpolatesExactlyOnPlanes) {
    const Errors errors = errorsOnRandomPlanes(Interpolation::Exact);
    EXPECT_GT(errors.texels, 100000);
    EXPECT_LT(errors.largest, 1e-6);
    EXPECT_LT(errors.largestDistance, 1e-6);
}

TEST(MemResampler, ErrsByMoreThanATexelWhenItInterpolatesAsInThePaper) {
    const Errors errors = errorsOnRandomPlanes(Interpolation::AsInPaper);
    EXPECT_GT(errors.texels, 100000);
    EXPECT_GT(errors.largest, 2.0 / 128.0);
}

TEST(MemResampler, LooksNothingUpInARemWhoseWeightIsZeroAtAllCorners) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const test::BoxCity ground(0, 0, 2, 2, 1.0);
    const HeightfieldTracer tracer(ground.heightfield());
    for (const bool useB : {false, true}) {
        const RemSet rems{
            test::plainMap("a", kPosition, 4, glm::vec3(useB ? nan : 0.25f), kInfinity),
            test::plainMap("b", kPosition, 4, glm::vec3(useB ? 0.75f : nan), kInfinity)};
        PlaneLeaf leaf = planeLeaf({1, 0, 0}, 10.0);
        for (MemVertex& vertex : leaf.face.vertices) {
            vertex.b = 1;
            vertex.weightA = useB ? 0.0 : 1.0;
            vertex.weightB = useB ? 1.0 : 0.0;
        }
        LocalEnvironmentMap map = emptyMap(16);
        const MemResampler resampler({&tracer, rems, 1000.0}, twoRems(), kPosition,
                                     Interpolation::Exact, map);
        resampler.writeLeaf(kFace, leaf.face, leaf.face.quads.front());
        EXPECT_EQ(map.radiance.at(kFace, 8, 8).x, useB ? 0.75f : 0.25f);
    }
}

TEST(MemResampler, InterpolatesTheWeightsBetweenTheCorners) {
    const test::BoxCity ground(0, 0, 2, 2, 1.0);
    const HeightfieldTracer tracer(ground.heightfield());
    const RemSet rems{test::plainMap("a", kPosition, 4, glm::vec3(0.0f), kInfinity),
                      test::plainMap("b", kPosition, 4, glm::vec3(1.0f), kInfinity)};
    PlaneLeaf leaf = planeLeaf({1, 0, 0}, 10.0);
    const double weights[4] = {0.0, 1.0, 0.5, 0.25};
    for (std::size_t k = 0; k < 4; ++k) {
        leaf.face.vertices[k].b = 1;
        leaf.face.vertices[k].weightB = weights[k];
        leaf.face.vertices[k].weightA = 1.0 - weights[k];
    }
    leaf.face.vertices[2].uncovered = true;
    LocalEnvironmentMap map = emptyMap(16);
    const MemResampler resampler({&tracer, rems, 1000.0}, twoRems(), kPosition,
                                 Interpolation::Exact, map);
    resampler.writeLeaf(kFace, leaf.face, leaf.face.quads.front());
    for (int row = 4; row < 12; ++row) {
        for (int column = 4; column < 12; ++column) {
            const double u = texelCoordinate(16, column) + 0.5;
            const double v = texelCoordinate(16, row) + 0.5;
            const double expected = (1 - v) * u + v * (0.5 * (1 - u) + 0.25 * u);
            ASSERT_NEAR(map.radiance.at(kFace, column, row).x, expected, 1e-6);
            ASSERT_EQ(map.uncovered.at(kFace, column, row), 1);
        }
    }
    EXPECT_EQ(map.radiance.at(kFace, 3, 8).x, -1.0f) << "a texel outside the leaf stays as it was";
    EXPECT_EQ(map.radiance.at(kFace, 12, 8).x, -1.0f);
}

TEST(MemResampler, PutsTheSkyAtInfinityInBothForms) {
    const test::BoxCity ground(0, 0, 2, 2, 1.0);
    const HeightfieldTracer tracer(ground.heightfield());
    const RemSet rems{test::coordinateMap("r", kPosition + glm::dvec3(30, 7, 1), 128, kInfinity)};
    for (const Interpolation interpolation : {Interpolation::Exact, Interpolation::AsInPaper}) {
        PlaneLeaf leaf = planeLeaf({1, 0, 0}, 10.0);
        for (MemVertex& vertex : leaf.face.vertices) {
            vertex.sky = true;
            vertex.inverseDepth = 0.0;
        }
        LocalEnvironmentMap map = emptyMap(32);
        const MemResampler resampler({&tracer, rems, 1000.0}, oneRem(), kPosition, interpolation,
                                     map);
        resampler.writeLeaf(kFace, leaf.face, leaf.face.quads.front());
        const double slack = interpolation == Interpolation::Exact ? 1e-6 : 0.05;
        EXPECT_NEAR(map.radiance.at(kFace, 12, 20).x, texelCoordinate(32, 12), slack);
        EXPECT_NEAR(map.radiance.at(kFace, 12, 20).y, texelCoordinate(32, 20), slack);
        EXPECT_EQ(map.distance.at(kFace, 12, 20), kInfinity);
    }
}

TEST(MemResampler, GivesATexelLeafThePointOfItsOwnRay) {
    const test::BoxCity ground(0, 0, 2, 2, 1.0);
    const HeightfieldTracer tracer(ground.heightfield());
    const glm::dvec3 center = kPosition + glm::dvec3(2.0, 1.0, -0.5);
    const RemSet rems{test::coordinateMap("r", center, 128, kInfinity)};
    MemVertex vertex;
    vertex.direction = texelDirection(3, kFace, 1, 1);
    vertex.a = 0;
    vertex.inverseDepth = 0.05;
    vertex.distance = 20.0;
    vertex.uncovered = true;
    const MemFace face{{vertex}, {{-0.2, -0.1, 0.2, 0.1, {0, 0, 0, 0}}}};
    LocalEnvironmentMap map = emptyMap(3);
    const MemResampler resampler({&tracer, rems, 1000.0}, oneRem(), kPosition, Interpolation::Exact,
                                 map);
    resampler.writeLeaf(kFace, face, face.quads.front());
    const FacePoint truth = facePoint(kPosition + 20.0 * vertex.direction - center);
    EXPECT_NEAR(map.radiance.at(kFace, 1, 1).x, truth.st.x, 1e-6);
    EXPECT_NEAR(map.radiance.at(kFace, 1, 1).y, truth.st.y, 1e-6);
    EXPECT_EQ(map.distance.at(kFace, 1, 1), 20.0f);
    EXPECT_EQ(map.uncovered.at(kFace, 1, 1), 1);
    EXPECT_EQ(map.uncovered.at(kFace, 0, 1), 7) << "the texel beside it stays as it was";
}

}  // namespace
}  // namespace reflet
