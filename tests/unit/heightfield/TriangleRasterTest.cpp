// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TriangleRaster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace reflet::test {
namespace {

/// Whether `up` is the float32 next to the value from above, or the value itself.
bool isTheLeastAbove(float up, double value) {
    return double(up) >= value && double(std::nextafter(up, -kInfinity)) < value;
}

TEST(TriangleRaster, RoundsUpToTheLeastFloatThatIsNotBelow) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
    for (int n = 0; n < 200000; ++n) {
        const double value = std::ldexp(mantissa(random), int(random() % 300) - 160);
        ASSERT_TRUE(isTheLeastAbove(roundedUp(value), value)) << value;
        ASSERT_TRUE(isTheLeastAbove(-roundedDown(value), -value)) << value;
    }
}

TEST(TriangleRaster, LeavesWhatIsAFloat) {
    for (const double value : {0.0, 1.0, -1.0, 0.125, -2048.5, 1e-45, 0.1}) {
        EXPECT_EQ(roundedUp(double(float(value))), float(value));
        EXPECT_EQ(roundedDown(double(float(value))), float(value));
    }
}

TEST(TriangleRaster, RoundsAcrossZeroAndPowersOfTwo) {
    using Limits = std::numeric_limits<double>;
    for (const double value :
         {Limits::denorm_min(), -Limits::denorm_min(), 1e-46, -1e-46, std::nextafter(1.0, 2.0),
          std::nextafter(1.0, 0.0), std::nextafter(-4.0, 0.0), std::nextafter(-4.0, -5.0)}) {
        EXPECT_TRUE(isTheLeastAbove(roundedUp(value), value)) << value;
        EXPECT_TRUE(isTheLeastAbove(-roundedDown(value), -value)) << value;
    }
}

TEST(TriangleRaster, FindsTheCellsThatAStretchTouchesWithItsEnds) {
    const GridLines lines = gridColumns({10.0, 0.0, 0.5, 20, 1}, ProjectFrame{});
    const auto touched = [&](double from, double to) {
        const CellRange range = touchedCells(lines, from, to);
        return std::pair(range.first, range.last);
    };
    EXPECT_EQ(touched(11.1, 11.2), std::pair(2, 3));
    EXPECT_EQ(touched(11.0, 11.2), std::pair(1, 3)) << "a border belongs to both its cells";
    EXPECT_EQ(touched(11.0, 11.5), std::pair(1, 4));
    EXPECT_EQ(touched(11.5, 11.5), std::pair(2, 4));
    EXPECT_EQ(touched(-5.0, 50.0), std::pair(0, 20));
    const auto [first, last] = touched(-5.0, 9.9);
    EXPECT_EQ(first, last) << "none";
    const auto [begin, end] = touched(20.1, 30.0);
    EXPECT_EQ(begin, end) << "none";
}

}  // namespace
}  // namespace reflet::test
