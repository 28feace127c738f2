// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

TEST(Box, IsEmptyUntilSomethingIsAdded) {
    Box box;
    EXPECT_TRUE(box.empty());
    EXPECT_EQ(box.size(), glm::dvec3(0.0));
    box.add(glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_FALSE(box.empty());
    EXPECT_EQ(box.size(), glm::dvec3(0.0)) << "a point has no size, but is not nothing";
    EXPECT_EQ(box.center(), glm::dvec3(1.0, 2.0, 3.0));
}

TEST(Box, HoldsTheExtremesOfAllPoints) {
    Box box;
    for (const glm::dvec3& p :
         {glm::dvec3(4.0, -1.0, 2.0), glm::dvec3(-3.0, 5.0, 2.5), glm::dvec3(0.0, 0.0, -7.0)})
        box.add(p);
    EXPECT_EQ(box.min, glm::dvec3(-3.0, -1.0, -7.0));
    EXPECT_EQ(box.max, glm::dvec3(4.0, 5.0, 2.5));
    EXPECT_EQ(box.size(), glm::dvec3(7.0, 6.0, 9.5));
    EXPECT_EQ(box.center(), glm::dvec3(0.5, 2.0, -2.25));
}

TEST(Box, TakesInOtherBoxesAndIsNotChangedByAnEmptyOne) {
    Box box;
    box.add(glm::dvec3(0.0));
    box.add(Box{});
    EXPECT_EQ(box.size(), glm::dvec3(0.0));
    box.add(Box{glm::dvec3(-1.0, 2.0, 0.0), glm::dvec3(1.0, 3.0, 4.0)});
    EXPECT_EQ(box.min, glm::dvec3(-1.0, 0.0, 0.0));
    EXPECT_EQ(box.max, glm::dvec3(1.0, 3.0, 4.0));
}

TEST(Ray, MeasuresItsParameterInLengthsOfItsDirection) {
    const Ray ray{glm::dvec3(1.0, 2.0, 3.0), glm::dvec3(0.0, 2.0, 0.0)};
    EXPECT_EQ(ray.at(0.0), ray.origin);
    EXPECT_EQ(ray.at(1.5), glm::dvec3(1.0, 5.0, 3.0));
}

TEST(Geometry, KnowsPi) {
    EXPECT_EQ(kPi, std::acos(-1.0));
}

}  // namespace
}  // namespace reflet
