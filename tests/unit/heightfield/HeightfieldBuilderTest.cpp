// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightfieldBuilder.h"
#include "tests/unit/heightfield/TestCity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet::test {
namespace {

GridSpec square(double extent, double cellSize) {
    const int count = int(std::lround(extent / cellSize));
    return {0.0, 0.0, cellSize, count, count};
}

Heightfield built(const CityModel& city, const GridSpec& grid) {
    auto field = buildHeightfield(city, grid, {});
    EXPECT_TRUE(field) << field.error().message();
    return field ? std::move(*field) : Heightfield{};
}

class CellSizes : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Heightfield, CellSizes, testing::Values(1.0, 0.5, 0.1, 0.3));

TEST_P(CellSizes, KeepExactBoxHeightsInEveryLayer) {
    const double s = GetParam();
    const glm::dvec2 low(6.25, 9.0);
    const glm::dvec2 high(12.5, 15.0);
    TestCity model;
    model.ground(0, 0, 30, 30, 2).box(glm::vec3(low, 2), glm::vec3(high, 17.5));
    const GridSpec grid = square(30.0, s);
    const Heightfield field = built(model.city, grid);
    int fattened = 0;
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            const std::size_t n = grid.index(i, j);
            // A nanometre decides what touches: 0.1 and 0.3 are not exact.
            const double west = i * s;
            const double south = j * s;
            const bool touches = west <= high.x + 1e-9 && west + s >= low.x - 1e-9 &&
                                 south <= high.y + 1e-9 && south + s >= low.y - 1e-9;
            const double x = west + 0.5 * s;
            const double y = south + 0.5 * s;
            const bool covers =
                x > low.x - 1e-9 && x < high.x + 1e-9 && y > low.y - 1e-9 && y < high.y + 1e-9;
            ASSERT_EQ(field.topMax[n], touches ? 17.5F : 2.0F) << i << " " << j;
            ASSERT_EQ(field.topCenter[n], covers ? 17.5F : 2.0F) << i << " " << j;
            ASSERT_EQ(field.ground[n], 2.0F) << i << " " << j;
            fattened += touches && !covers;
        }
    }
    EXPECT_GT(fattened, 0);
}

TEST_P(CellSizes, TakeTheHighestCornerOfEachCellOnATiltedPlane) {
    const double s = GetParam();
    const auto plane = [](double x, double y) { return 3.0 + 0.5 * x - 0.25 * y; };
    const auto corner = [&](float x, float y) { return glm::vec3(x, y, plane(x, y)); };
    TestCity model;
    model.object(CityObjectType::Building, SurfaceType::Roof)
        .quad(corner(-2, -2), corner(34, -2), corner(34, 34), corner(-2, 34));
    const GridSpec grid = square(30.0, s);
    const Heightfield field = built(model.city, grid);
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            const std::size_t n = grid.index(i, j);
            const double highest = plane(grid.xMin(i + 1), grid.yMin(j));
            ASSERT_GE(double(field.topMax[n]), highest - 1e-9);
            ASSERT_LE(double(field.topMax[n]), highest + 4e-6);  // one float32 step at 18 m: 1.9e-6
            ASSERT_NEAR(double(field.topCenter[n]),
                        plane(grid.xMin(i) + 0.5 * s, grid.yMin(j) + 0.5 * s), 1e-6);
            ASSERT_TRUE(isMissing(field.ground[n]));
        }
    }
}

TEST(Heightfield, KeepsTheExactMaximumOfATriangleClippedToACell) {
    TestCity model;
    model.object(CityObjectType::Building)
        .triangle({0.5F, 0.5F, 0}, {4.5F, 0.5F, 8}, {0.5F, 4.5F, 4});
    const Heightfield field = built(model.city, square(5.0, 1.0));
    // z = 2(x - 0.5) + (y - 0.5); in cell (1, 1) it is highest at (2, 2), in cell (3, 1), which the
    // hypotenuse x + y = 5 crosses, at (4, 1), in (2, 2) at (3, 2); in cell (4, 0) at the corner
    // (4.5, 0.5).
    EXPECT_EQ(field.topMax[field.grid.index(1, 1)], 4.5F);
    EXPECT_EQ(field.topMax[field.grid.index(3, 1)], 7.5F);
    EXPECT_EQ(field.topMax[field.grid.index(4, 0)], 8.0F);
    EXPECT_EQ(field.topMax[field.grid.index(2, 2)], 6.5F);
    EXPECT_TRUE(isMissing(field.topMax[field.grid.index(4, 4)]));
    EXPECT_TRUE(isMissing(field.topMax[field.grid.index(4, 2)]));
}

TEST(Heightfield, CountsAWallOnACellBorderInBothCellsOfTheMaximumAndInNeitherCentre) {
    TestCity model;
    model.ground(0, 0, 6, 6, 0).object(CityObjectType::Building, SurfaceType::Wall);
    model.quad({3, 1, 0}, {3, 5, 0}, {3, 5, 9}, {3, 1, 9});
    const Heightfield field = built(model.city, square(6.0, 1.0));
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(field.topMax[field.grid.index(i, 3)], i == 2 || i == 3 ? 9.0F : 0.0F) << i;
        EXPECT_EQ(field.topCenter[field.grid.index(i, 3)], 0.0F) << i;
    }
}

TEST(Heightfield, DoesNotFattenAWallThatRunsThroughCellCentres) {
    TestCity model;
    model.ground(0, 0, 6, 6, 0).object(CityObjectType::Building, SurfaceType::Wall);
    model.quad({3.5F, 1, 0}, {3.5F, 5, 0}, {3.5F, 5, 9}, {3.5F, 1, 9});
    const Heightfield field = built(model.city, square(6.0, 1.0));
    EXPECT_EQ(field.topMax[field.grid.index(3, 3)], 9.0F);
    EXPECT_EQ(field.topCenter[field.grid.index(3, 3)], 0.0F);
}

TEST(Heightfield, LeavesGroundAndClosureSurfacesOutOfTheTop) {
    TestCity model;
    model.object(CityObjectType::Building, SurfaceType::Ground)
        .quad({0, 0, 5}, {2, 0, 5}, {2, 2, 5}, {0, 2, 5});
    model.surface(SurfaceType::Closure).quad({0, 0, 7}, {2, 0, 7}, {2, 2, 7}, {0, 2, 7});
    model.surface(SurfaceType::OuterCeiling).quad({0, 0, 3}, {0, 2, 3}, {2, 2, 3}, {2, 0, 3});
    const Heightfield field = built(model.city, square(2.0, 1.0));
    for (const float height : field.topMax) {
        EXPECT_EQ(height, 3.0F);
    }
}

TEST(Heightfield, CountsVegetationAndTerrainInTheTopButOnlyTerrainInTheGround) {
    TestCity model;
    model.ground(0, 0, 4, 4, 1).object(CityObjectType::SolitaryVegetation);
    model.quad({1, 1, 6}, {3, 1, 6}, {3, 3, 6}, {1, 3, 6});
    const Heightfield field = built(model.city, square(4.0, 1.0));
    EXPECT_EQ(field.topCenter[field.grid.index(1, 2)], 6.0F);
    EXPECT_EQ(field.ground[field.grid.index(1, 2)], 1.0F);
    EXPECT_EQ(field.topCenter[field.grid.index(3, 3)], 1.0F);
}

TEST(Heightfield, InterpolatesTheGroundUnderABuildingFromTheTerrainAroundIt) {
    // A slope z = x/4 with a hole [3, 6]² under a building.
    const auto at = [](float x, float y) { return glm::vec3(x, y, 0.25F * x); };
    TestCity model;
    model.object(CityObjectType::TinRelief);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            if (i != 1 || j != 1) {
                const auto x = float(3 * i);
                const auto y = float(3 * j);
                model.quad(at(x, y), at(x + 3, y), at(x + 3, y + 3), at(x, y + 3));
            }
        }
    }
    model.box({3.25F, 3, 0}, {6, 6, 10});
    const GridSpec grid{-2.0, -2.0, 0.5, 26, 26};
    const Heightfield field = built(model.city, grid);
    int inHole = 0;
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            const double x = grid.xMin(i) + 0.25;
            const double y = grid.yMin(j) + 0.25;
            const bool known = x > 0 && x < 9 && y > 0 && y < 9;
            const bool hole = x > 3 && x < 6 && y > 3 && y < 6;
            const float ground = field.ground[grid.index(i, j)];
            ASSERT_EQ(isMissing(ground), !known);
            if (known) {
                ASSERT_NEAR(ground, 0.25 * x, 1e-6);
                ASSERT_NEAR(field.groundAt(x, y), 0.25 * x, 1e-6);
            }
            if (hole) {
                // The strip between terrain and building shows the interpolated ground.
                ASSERT_NEAR(field.topCenter[grid.index(i, j)], x < 3.25 ? 0.25 * x : 10.0, 1e-6);
                ++inHole;
            }
        }
    }
    EXPECT_EQ(inHole, 36);
}

TEST(Heightfield, AnswersGroundQueriesBetweenCellCentresAndNowhereElse) {
    Heightfield field;
    field.grid = {10.0, 20.0, 2.0, 3, 2};
    field.ground = {1, 2, 4, 3, kMissingHeight, 6};
    EXPECT_FLOAT_EQ(field.groundAt(11.0, 21.0), 1.0F);
    EXPECT_FLOAT_EQ(field.groundAt(12.0, 21.0), 1.5F);
    EXPECT_FLOAT_EQ(field.groundAt(10.0, 20.0), 1.0F);  // nearest beyond the outermost centres
    EXPECT_FLOAT_EQ(field.groundAt(11.0, 21.5), 1.5F);
    EXPECT_FLOAT_EQ(field.groundAt(12.5, 21.5),
                    (0.25F * 0.75F * 1 + 0.75F * 0.75F * 2 + 0.25F * 0.25F * 3) / 0.8125F);
    EXPECT_TRUE(isMissing(field.groundAt(13.0, 23.0)));
    EXPECT_TRUE(isMissing(field.groundAt(16.0, 21.0)));
    EXPECT_TRUE(isMissing(field.groundAt(9.999, 21.0)));
    EXPECT_TRUE(isMissing(field.groundAt(std::nan(""), 21.0)));
}

TEST(Heightfield, SkipsTrianglesWithCoordinatesThatAreNotFinite) {
    TestCity model;
    const float nan = std::nanf("");
    model.object(CityObjectType::TinRelief)
        .triangle({0, 0, 1}, {2, 0, 1}, {0, 2, nan})
        .triangle({0, 0, kInfinity}, {2, 0, 1}, {0, 2, 1})
        .triangle({0, 0, 1}, {kInfinity, 0, 1}, {0, 2, 1})
        .triangle({0, 0, 4}, {2, 0, 4}, {0, 2, 4});
    const Heightfield field = built(model.city, square(2.0, 1.0));
    EXPECT_EQ(field.topMax[0], 4.0F);
    EXPECT_EQ(field.ground[0], 4.0F);
}

TEST(Heightfield, StopsWhenItsJobIsCancelled) {
    TestCity model = randomTriangles(1000, 50.0F, 3);
    std::stop_source source;
    source.request_stop();
    const auto field =
        buildHeightfield(model.city, square(50.0, 1.0), JobContext({}, source.get_token()));
    ASSERT_FALSE(field);
    EXPECT_EQ(field.error().code, ErrorCode::Cancelled);
}

TEST(Heightfield, RefusesAGridWithoutCells) {
    const auto field = buildHeightfield(randomTriangles(1, 5.0F, 1).city, GridSpec{}, {});
    ASSERT_FALSE(field);
    EXPECT_EQ(field.error().code, ErrorCode::Usage);
}

}  // namespace
}  // namespace reflet::test
