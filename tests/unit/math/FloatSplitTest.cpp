// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/FloatSplit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace reflet {
namespace {

TEST(FloatSplit, GivesTheKnownPartsOfACoordinateInUtm) {
    // The floats next to these coordinates are 1/32 m and 1/2 m apart.
    const HighLow3 split = splitFloat(glm::dvec3(389123.456, 5820123.789, 34.5));
    EXPECT_EQ(split.high, glm::vec3(389123.46875F, 5820124.0F, 34.5F));
    EXPECT_NEAR(split.low.x, -0.01275, 1e-9);
    EXPECT_NEAR(split.low.y, -0.211, 1e-8);
    EXPECT_EQ(split.low.z, 0.0F);
}

/// Splits a whole array in a loop, as an upload to the GPU does: what a vectoriser loves.
std::vector<HighLow3> splitAll(const std::vector<glm::dvec3>& positions) {
    std::vector<HighLow3> parts(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        parts[i] = splitFloat(positions[i]);
    return parts;
}

TEST(FloatSplit, KeepsFortyEightBitsOfEveryCoordinateOfAnArray) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> east(200'000.0, 900'000.0);
    std::uniform_real_distribution<double> north(0.0, 9'300'000.0);
    std::uniform_real_distribution<double> up(-400.0, 4'800.0);
    std::vector<glm::dvec3> positions(10'007);
    for (auto& position : positions)
        position = {east(random), north(random), up(random)};

    const auto parts = splitAll(positions);
    std::size_t withLowPart = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const double value = positions[i][axis];
            const double sum = double{parts[i].high[axis]} + double{parts[i].low[axis]};
            ASSERT_LE(std::abs(sum - value), std::ldexp(std::abs(value), -48));
            withLowPart += parts[i].low[axis] != 0.0F ? 1 : 0;
        }
    }
    EXPECT_GT(withLowPart, positions.size() * 2) << "the low parts were optimised away";
}

TEST(FloatSplit, NeighbouringComponentsKeepTheirLowParts) {
    double coordinates[2] = {389123.456, 5820123.789};
    HighLow split[2];
    for (int i = 0; i < 2; ++i)
        split[i] = splitFloat(coordinates[i]);
    EXPECT_NE(split[0].low, 0.0F);
    EXPECT_NE(split[1].low, 0.0F);
}

TEST(FloatSplit, LeavesNothingOverForWhatAFloatHolds) {
    for (const double value : {0.0, -0.0, 1.0, -0.375, 16777216.0, 1e-40}) {
        const HighLow split = splitFloat(static_cast<double>(static_cast<float>(value)));
        EXPECT_EQ(split.high, static_cast<float>(value));
        EXPECT_EQ(split.low, 0.0F);
    }
}

TEST(FloatSplit, TakesNegativeCoordinates) {
    const HighLow split = splitFloat(-5820123.789);
    EXPECT_EQ(split.high, -5820124.0F);
    EXPECT_NEAR(split.low, 0.211, 1e-8);
}

}  // namespace
}  // namespace reflet
