// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/BuiltBounds.h"

#include <gtest/gtest.h>

namespace {

using namespace reflet;

Heightfield plain(int edge) {
    Heightfield field;
    field.grid = {-10.0, 20.0, 1.0, edge, edge};
    field.ground.assign(field.grid.cellCount(), 3.0F);
    field.topMax = field.ground;
    field.topCenter = field.ground;
    return field;
}

void raise(Heightfield& field, std::size_t cell, float top) {
    field.topMax[cell] = field.topCenter[cell] = top;
}

TEST(BuiltBounds, IsTheBoxOfTheHousesNotOfTheGroundAroundThem) {
    Heightfield field = plain(30);
    raise(field, field.grid.index(12, 5), 11.0F);
    raise(field, field.grid.index(14, 9), 8.0F);
    raise(field, field.grid.index(29, 29), 4.0F);  // a car
    const Box box = builtBounds(field);
    EXPECT_EQ(box.min, glm::dvec3(2.0, 25.0, 3.0));
    EXPECT_EQ(box.max, glm::dvec3(5.0, 30.0, 11.0));
}

TEST(BuiltBounds, ASteepSlopeIsNoHouse) {
    Heightfield field = plain(20);
    raise(field, field.grid.index(3, 3), 12.0F);
    // The corner of a cell on the slope is far above its centre, which is ground.
    for (int j = 10; j < 20; ++j)
        for (int i = 0; i < 20; ++i)
            field.topMax[field.grid.index(i, j)] = 9.0F;
    EXPECT_EQ(builtBounds(field).min, glm::dvec3(-7.0, 23.0, 3.0));
    EXPECT_EQ(builtBounds(field).max, glm::dvec3(-6.0, 24.0, 12.0));
}

TEST(BuiltBounds, IsAllOfItWhereNothingStands) {
    const Box box = builtBounds(plain(4));
    EXPECT_EQ(box.min, glm::dvec3(-10.0, 20.0, 3.0));
    EXPECT_EQ(box.max, glm::dvec3(-6.0, 24.0, 3.0));
}

TEST(BuiltBounds, TheBusiestSquareIsWhereMostStands) {
    Heightfield field = plain(400);
    // Six lone houses along the diagonal, and four together in a square of 30 m.
    for (int k = 0; k < 6; ++k)
        raise(field, field.grid.index(60 * k, 60 * k), 9.0F);
    for (const auto& [i, j] : {std::pair{301, 110}, {309, 110}, {301, 125}, {312, 131}})
        raise(field, field.grid.index(i, j), 8.0F);
    const Box box = busiestBounds(field, 100.0);
    EXPECT_EQ(box.min, glm::dvec3(291.0, 130.0, 3.0));
    EXPECT_EQ(box.max, glm::dvec3(303.0, 152.0, 8.0));
}

TEST(BuiltBounds, TheBusiestSquareOfASmallCityOrAnEmptyOneIsAllOfIt) {
    Heightfield field = plain(30);
    raise(field, field.grid.index(12, 5), 11.0F);
    EXPECT_EQ(busiestBounds(field, 1000.0).min, builtBounds(field).min);
    EXPECT_EQ(busiestBounds(field, 1000.0).max, builtBounds(field).max);
    EXPECT_FALSE(busiestBounds(plain(300), 50.0).empty());
    EXPECT_TRUE(busiestBounds(Heightfield{}, 50.0).empty());
}

TEST(BuiltBounds, LeavesOutWhatIsMissingAndIsEmptyWhenAllIs) {
    Heightfield field = plain(3);
    for (float& z : field.ground)
        z = kMissingHeight;
    EXPECT_TRUE(builtBounds(field).empty());
}

}  // namespace
