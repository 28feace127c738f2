// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/MapTexels.h"

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace reflet {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

double valueOf(std::uint16_t half) {
    return double(glm::unpackHalf1x16(half));
}

/// The nearest of two halves that follow each other, by the definition: the even one of a tie.
std::uint16_t nearerOf(std::uint16_t below, double value) {
    const auto above = std::uint16_t(below + 1);
    // Beyond the largest, half floats round as if 65536 came next.
    const double next = above == 0x7c00 ? 65536.0 : valueOf(above);
    const double down = value - valueOf(below), up = next - value;
    if (down != up)
        return down < up ? below : above;
    return below % 2 == 0 ? below : above;
}

TEST(HalfFloats, EachOfThemStaysWhatItIs) {
    for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
        const float value = glm::unpackHalf1x16(std::uint16_t(bits));
        if (std::isnan(value))
            continue;
        ASSERT_EQ(halfOf(value), bits) << value;
    }
    EXPECT_TRUE(std::isnan(glm::unpackHalf1x16(halfOf(std::nanf("")))));
}

TEST(HalfFloats, AreTheNearestAndEvenOfTwo) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    for (std::uint32_t bits = 0; bits < 0x7c00; ++bits) {
        const auto half = std::uint16_t(bits);
        const double low = valueOf(half);
        const double high = bits == 0x7bff ? 65536.0 : valueOf(std::uint16_t(bits + 1));
        // Halves have 11 digits and floats 24: the middle and its neighbours are floats.
        const auto middle = float(0.5 * (low + high));
        for (const float value :
             {middle, std::nextafter(middle, 0.0F), std::nextafter(middle, kInfinity),
              float(low + (high - low) * double(share(random)))}) {
            ASSERT_EQ(halfOf(value), nearerOf(half, double(value))) << value;
            ASSERT_EQ(halfOf(-value), nearerOf(half, double(value)) | 0x8000U) << -value;
        }
    }
    EXPECT_EQ(halfOf(1e30F), 0x7c00);
    EXPECT_EQ(halfOf(kInfinity), 0x7c00);
    EXPECT_EQ(halfOf(-kInfinity), 0xfc00);
    EXPECT_EQ(halfOf(1e-12F), 0);
}

struct Map {
    explicit Map(int n) : radiance(n), distance(n), uncovered(n) {
        std::mt19937 random{std::uint32_t(n)};
        std::uniform_real_distribution<float> value(0.0F, 4.0F);
        for (std::size_t i = 0; i < distance.texels().size(); ++i) {
            radiance.texels()[i] = {value(random), value(random), value(random)};
            distance.texels()[i] = 50.0F * value(random);
            uncovered.texels()[i] = i % 5 == 0 ? 1 : 0;
        }
    }
    CubeMap<glm::vec3> radiance;
    CubeMap<float> distance;
    CubeMap<unsigned char> uncovered;
};

TEST(MapTexels, LevelsAreMeansOfTheTexelsThatTheyCover) {
    constexpr int kEdge = 16;
    const Map map(kEdge);
    const MapTexels texels = mapTexels(map.radiance, map.distance, map.uncovered);
    ASSERT_EQ(texels.levels, 5);
    ASSERT_EQ(texels.halves.size(), texels.offset(5));
    for (int level = 0; level < texels.levels; ++level) {
        const int edge = kEdge >> level, wide = 1 << level;
        const std::uint16_t* half = &texels.halves[texels.offset(level)];
        for (int face = 0; face < 6; ++face) {
            for (int row = 0; row < edge; ++row) {
                for (int column = 0; column < edge; ++column, half += 4) {
                    glm::dvec4 sum(0.0);
                    for (int k = 0; k < wide * wide; ++k) {
                        const int x = column * wide + k % wide, y = row * wide + k / wide;
                        sum += glm::dvec4(glm::dvec3(map.radiance.at(face, x, y)),
                                          double(map.distance.at(face, x, y)));
                    }
                    sum /= double(wide * wide);
                    for (int c = 0; c < 4; ++c)
                        ASSERT_NEAR(std::abs(valueOf(half[c])), sum[c], sum[c] / 1500.0 + 1e-7);
                    const bool marked = level == 0 && map.uncovered.at(face, column, row) != 0;
                    ASSERT_EQ((half[3] & 0x8000U) != 0, marked);
                }
            }
        }
    }
}

TEST(MapTexels, RadianceStaysFiniteAndTheSkyFar) {
    CubeMap<glm::vec3> radiance(2, glm::vec3(1e9F));
    const MapTexels texels = mapTexels(radiance, CubeMap<float>(2, kInfinity));
    for (std::size_t i = 0; i < texels.halves.size(); ++i)
        EXPECT_EQ(valueOf(texels.halves[i]), i % 4 == 3 ? double(kInfinity) : 65504.0);
}

TEST(MapTexels, OtherSizesHaveTheirFirstLevelAlone) {
    const Map odd(12), even(8);
    EXPECT_EQ(mapTexels(odd.radiance, odd.distance).levels, 1);
    const MapTexels all = mapTexels(even.radiance, even.distance);
    const MapTexels first = mapTexels(even.radiance, even.distance, {}, MapLevels::First);
    ASSERT_EQ(first.levels, 1);
    ASSERT_EQ(first.halves.size(), all.offset(1));
    EXPECT_TRUE(std::equal(first.halves.begin(), first.halves.end(), all.halves.begin()));
}

}  // namespace
}  // namespace reflet
