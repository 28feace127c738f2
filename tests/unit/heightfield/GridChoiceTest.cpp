// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightfieldBuilder.h"
#include "tests/unit/heightfield/TestCity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet::test {
namespace {

CityModel cityOver(glm::vec3 low, glm::vec3 high, glm::dvec3 origin = glm::dvec3(0.0)) {
    TestCity model;
    model.box(low, high);
    model.city.frame.origin = origin;
    return model.city;
}

HeightfieldSettings cells(double size) {
    HeightfieldSettings settings;
    settings.cellSize = size;
    return settings;
}

GridSpec chosen(const CityModel& city, const HeightfieldSettings& settings = {}) {
    const auto grid = gridFor(city, settings);
    EXPECT_TRUE(grid) << grid.error().message();
    return grid.value_or(GridSpec{});
}

TEST(GridChoice, TakesTheFinestCellWithinTheLimitAndGrowsItForHugeCities) {
    const auto sizeFor = [](float extent) {
        return chosen(cityOver({0, 0, 0}, {extent, extent, 9})).cellSize;
    };
    EXPECT_EQ(sizeFor(100), 0.5);
    EXPECT_EQ(sizeFor(1000), 0.5);  // exactly four million
    EXPECT_EQ(sizeFor(1001), 0.625);
    EXPECT_EQ(sizeFor(2000), 1.0);
    EXPECT_EQ(sizeFor(4000), 2.0);
    EXPECT_EQ(chosen(cityOver({0, 0, 0}, {9000, 10000, 9})).cellSize, 5.0);
    EXPECT_EQ(sizeFor(1e6F), 500.0);
    EXPECT_GT(sizeFor(1e30F), 1e26);
}

TEST(GridChoice, CoversTheBoundsWithCellsThatAreMultiplesOfTheirSizeInTheCrs) {
    const glm::vec3 low(-812.3F, 1203.7F, 0);
    const glm::vec3 high(455.5F, 2718.2F, 30);
    const glm::dvec3 origin(389000.0, 5820000.0, 0.0);
    for (const double s : {0.3, 0.5, 0.7, 1.0, 2.0, 3.0}) {
        const GridSpec grid = chosen(cityOver(low, high, origin), cells(s));
        EXPECT_EQ(grid.cellSize, s);
        EXPECT_LE(grid.x0, low.x);
        EXPECT_GT(grid.x0 + s, low.x);
        EXPECT_LE(grid.y0, low.y);
        EXPECT_GT(grid.y0 + s, low.y);
        EXPECT_GE(grid.xMax(), double(high.x) - 1e-9);
        EXPECT_LT(grid.xMax() - s, high.x);
        EXPECT_GE(grid.yMax(), double(high.y) - 1e-9);
        EXPECT_LT(grid.yMax() - s, high.y);
        EXPECT_LT(std::abs(std::remainder(origin.x + grid.x0, s)), 1e-6);
        EXPECT_LT(std::abs(std::remainder(origin.y + grid.y0, s)), 1e-6);
    }
}

TEST(GridChoice, ShiftsTheGridWhereTheOriginIsNoMultipleOfTheCell) {
    // 5 800 000 = 1 933 333·3 + 1, so lines lie at 2, 5, 8 ... metres north of the origin.
    const GridSpec grid = chosen(cityOver({0.5F, 2.5F, 0}, {9, 9, 9}, {0, 5.8e6, 0}), cells(3.0));
    EXPECT_EQ(grid.x0, 0.0);
    EXPECT_EQ(grid.y0, 2.0);
    EXPECT_EQ(grid.rows, 3);
}

TEST(GridChoice, NeedsNoExtraCellWhenTheBoundsEndOnABorder) {
    const GridSpec grid = chosen(cityOver({0, 0, 0}, {1.5F, 3.0F, 2}), cells(0.3));
    EXPECT_EQ(grid.columns, 5);
    EXPECT_EQ(grid.rows, 10);
}

TEST(GridChoice, GivesAFlatOrPointLikeCityOneCellAtLeast) {
    const GridSpec grid = chosen(cityOver({4, 4, 0}, {4, 4, 0}), cells(1.0));
    EXPECT_EQ(grid.cellCount(), 1U);
    EXPECT_EQ(grid.x0, 4.0);
}

TEST(GridChoice, RefusesTooManyCellsAndNamesASizeThatFits) {
    const CityModel city = cityOver({0, 0, 0}, {10000, 10000, 9});
    const auto grid = gridFor(city, cells(0.1));
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::ResourceLimit);
    EXPECT_EQ(grid.error().message(),
              "heightfield: cells of 0.1 m would need 1e+04 million of them, more than 64 million. "
              "Take cells of 1.25 m or more, or leave the cell size to Reflet");
    EXPECT_TRUE(gridFor(city, cells(1.25)));
}

TEST(GridChoice, RefusesCellsSoSmallThatTheirNumberOverflows) {
    HeightfieldSettings settings = cells(1e-300);
    settings.cellLimit = std::numeric_limits<std::size_t>::max();
    const auto grid = gridFor(cityOver({0, 0, 0}, {1000, 1000, 9}), settings);
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::ResourceLimit);
}

TEST(GridChoice, RefusesSizesThatAreNoSizes) {
    const CityModel city = cityOver({0, 0, 0}, {10, 10, 9});
    for (const double size : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        const auto grid = gridFor(city, cells(size));
        ASSERT_FALSE(grid);
        EXPECT_EQ(grid.error().code, ErrorCode::Usage);
        EXPECT_FALSE(grid.error().remedy.empty());
    }
}

TEST(GridChoice, RefusesACityWithoutGeometry) {
    const auto grid = gridFor(CityModel{}, {});
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::Refused);
    EXPECT_FALSE(grid.error().remedy.empty());
}

}  // namespace
}  // namespace reflet::test
