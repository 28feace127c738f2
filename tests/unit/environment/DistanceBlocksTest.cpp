// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/environment/DistanceBlocks.h"
#include "core/environment/DistanceForms.h"
#include "core/math/Geometry.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reflet {
namespace {

/// The distance along a ray, in closed form.
template <class Distance>
CubeMap<float> seen(int resolution, const Distance& distance) {
    CubeMap<float> map(resolution);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < resolution; ++row) {
            for (int column = 0; column < resolution; ++column) {
                map.at(face, column, row) =
                    float(distance(glm::normalize(texelDirection(resolution, face, column, row))));
            }
        }
    }
    return map;
}

/// A ray from the origin against a box that does not hold it.
double toBox(const glm::dvec3& d, const glm::dvec3& low, const glm::dvec3& high) {
    double from = 0.0;
    double to = double(kInfinity);
    for (int axis = 0; axis < 3; ++axis) {
        const double a = low[axis] / d[axis];
        const double b = high[axis] / d[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from < to ? from : double(kInfinity);
}

/// A street: ground 2 m below, houses on both sides, a tower far away, poles, sky above.
double toStreet(const glm::dvec3& d) {
    double t = d.z < 0.0 ? -2.0 / d.z : double(kInfinity);
    for (int i = -6; i < 6; ++i) {
        const double y = 15.0 * i;
        t = std::min(
            t, toBox(d, {8.0 + (i & 1), y + 1.0, -2.0}, {20.0, y + 14.0, 9.0 + 2.0 * (i & 3)}));
        t = std::min(t, toBox(d, {-25.0, y + 3.0, -2.0}, {-9.0, y + 12.0, 14.0 - (i & 3)}));
        t = std::min(t, toBox(d, {5.0, y + 0.2, -2.0}, {5.2, y + 0.4, 4.0}));
    }
    return std::min(t, toBox(d, {-30.0, 400.0, -2.0}, {-10.0, 420.0, 90.0}));
}

double tolerance(double distance) {
    return 0.021 + 2.1e-4 * distance;
}

void expectRight(const CubeMap<float>& out, const CubeMap<float>& map) {
    ASSERT_EQ(out.texels().size(), map.texels().size());
    for (std::size_t i = 0; i < map.texels().size(); ++i) {
        const float before = map.texels()[i];
        if (std::isinf(before))
            ASSERT_TRUE(std::isinf(out.texels()[i])) << i;
        else
            ASSERT_NEAR(out.texels()[i], before, tolerance(double(before))) << i;
    }
}

TEST(DistanceBlocks, ARoomIsRightEverywhere) {
    const auto room = [](const glm::dvec3& d) {
        double t = double(kInfinity);
        const glm::dvec3 low(-31.0, -4.0, -1.7);
        const glm::dvec3 high(3.0, 250.0, 22.0);
        for (int axis = 0; axis < 3; ++axis)
            t = std::min(t, (d[axis] < 0.0 ? low[axis] : high[axis]) / d[axis]);
        return t;
    };
    for (const int resolution : {64, 90, 128}) {
        const CubeMap<float> map = seen(resolution, room);
        expectRight(decodeDistances(encodeDistances(map)), map);
    }
}

TEST(DistanceBlocks, AStreetWithItsSilhouettesIsRightEverywhere) {
    const CubeMap<float> map = seen(128, toStreet);
    const DistanceBlocks blocks = encodeDistances(map);
    EXPECT_EQ(2 * blocks.bytes(), map.texels().size());  // half a byte a texel
    expectRight(decodeDistances(blocks), map);
}

TEST(DistanceBlocks, AllFormsAreUsed) {
    const DistanceBlocks blocks = encodeDistances(seen(128, toStreet));
    std::array<int, 4> count{};
    for (std::size_t i = 0; i < blocks.words.size(); ++i)
        ++count[blocks.words[i / 2] >> (32 * (i % 2)) & 3U];
    for (const int each : count)
        EXPECT_GT(each, 10);
}

TEST(DistanceBlocks, SkyIsSkyAndWhatIsNoDistanceToo) {
    EXPECT_TRUE(
        std::isinf(decodeDistances(encodeDistances(CubeMap<float>(7, kInfinity))).at(3, 6, 6)));
    CubeMap<float> map(64, 10.0F);
    map.at(1, 20, 20) = std::numeric_limits<float>::quiet_NaN();
    map.at(1, 21, 20) = -1.0F;
    map.at(1, 22, 20) = 0.0F;
    map.at(1, 23, 20) = kInfinity;
    const CubeMap<float> out = decodeDistances(encodeDistances(map));
    for (int column = 20; column < 24; ++column)
        EXPECT_TRUE(std::isinf(out.at(1, column, 20)));
    EXPECT_NEAR(out.at(1, 20, 21), 10.0F, 0.02F);
}

CubeMap<float> noise(int resolution, double share) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    CubeMap<float> map = seen(resolution, [](const glm::dvec3& d) {
        return 12.0 / std::max(std::abs(d.x), std::max(std::abs(d.y), std::abs(d.z)));
    });
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < resolution; row += 4) {
            for (int column = 0; column < resolution; column += 4) {
                const bool noisy = double(unit(random)) < share;
                for (int i = 0; i < 16; ++i) {
                    const float drawn = std::exp2(8.0F * unit(random));
                    if (noisy)
                        map.at(face, column + i % 4, row + i / 4) = drawn;
                }
            }
        }
    }
    return map;
}

TEST(DistanceBlocks, LeavesAndGratingsAreRightWhileThereIsRoom) {
    const CubeMap<float> map = noise(128, 0.1);
    expectRight(decodeDistances(encodeDistances(map)), map);
}

TEST(DistanceBlocks, BeyondItsRoomAMapGetsRoughAndNotLarger) {
    for (const int resolution : {4, 8, 64}) {
        const CubeMap<float> map = noise(resolution, 1.0);
        const DistanceBlocks blocks = encodeDistances(map);
        EXPECT_EQ(2 * blocks.bytes(), map.texels().size());
        const CubeMap<float> out = decodeDistances(blocks);
        std::size_t right = 0;
        for (std::size_t i = 0; i < map.texels().size(); ++i) {
            ASSERT_FALSE(std::isnan(out.texels()[i]));
            ASSERT_GT(out.texels()[i], 0.0F);
            right += std::abs(out.texels()[i] - map.texels()[i]) <=
                     float(tolerance(double(map.texels()[i])));
        }
        // An eighth of the blocks can be told texel by texel, less what is rounded off.
        EXPECT_GE(right + 16, map.texels().size() / 8) << resolution;
    }
}

TEST(DistanceBlocks, AnyResolutionComesBack) {
    for (const int resolution : {1, 2, 3, 5, 6, 33}) {
        const CubeMap<float> map(resolution, 3.0F);
        const CubeMap<float> out = decodeDistances(encodeDistances(map));
        ASSERT_EQ(out.resolution(), resolution);
        // A sphere of 3 m: rough where a face is a single block of it.
        for (const float distance : out.texels())
            EXPECT_NEAR(distance, 3.0F, 1.0F);
    }
}

TEST(DistanceBlocks, IsTheSameWithAnyNumberOfThreads) {
    const CubeMap<float> map = seen(64, toStreet);
    setThreadLimit(1);
    const auto one = encodeDistances(map).words;
    setThreadLimit(4);
    const auto four = encodeDistances(map).words;
    setThreadLimit(0);
    EXPECT_EQ(one, four);
}

TEST(DistanceBlocks, WordsOfAnySortAreReadWithinBounds) {
    std::mt19937_64 random(9);
    DistanceBlocks blocks{30, std::vector<std::uint64_t>(6 * 8 * 8)};
    for (auto& word : blocks.words)
        word = random();
    const CubeMap<float> out = decodeDistances(blocks);
    for (const float distance : out.texels())
        EXPECT_GT(distance, 0.0F);
}

TEST(DistanceForms, SmallFloatsKeepTheirMantissa) {
    using namespace distance_forms;
    for (const unsigned mantissa : {7U, 11U, 17U}) {
        for (float value = 1.1e-6F; value < 3000.0F; value *= 1.37F) {
            const auto bits = unsigned(smallFloat(value, mantissa));
            EXPECT_LT(bits, 1U << (mantissa + 5U));
            EXPECT_NEAR(fromSmallFloat(bits, mantissa), value,
                        value * std::exp2(-float(mantissa) - 1.0F));
        }
        EXPECT_EQ(smallFloat(0.0F, mantissa), 0U);
        EXPECT_EQ(fromSmallFloat(0, mantissa), 0.0F);
        EXPECT_GT(fromSmallFloat(unsigned(smallFloat(1e-12F, mantissa)), mantissa), 0.0F);
        EXPECT_EQ(smallFloat(1e30F, mantissa), (1U << (mantissa + 5U)) - 1U);
    }
}

}  // namespace
}  // namespace reflet
