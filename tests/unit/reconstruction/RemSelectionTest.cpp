// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/Reconstruction.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

ReferenceEnvironmentMap remAt(std::string id, const glm::dvec3& center) {
    return test::plainMap(std::move(id), center, 1, glm::vec3(1.0f), kInfinity);
}

TEST(RemSelection, ChoosesNothingFromNothing) {
    const RemChoice choice = chooseRems({}, {0, 0, 0});
    EXPECT_FALSE(choice.a);
    EXPECT_FALSE(choice.b);
}

TEST(RemSelection, ChoosesASingleRemAlone) {
    const RemSet rems{remAt("only", {100, 0, 0})};
    const RemChoice choice = chooseRems(rems, {0, 0, 0});
    EXPECT_EQ(choice.a, 0u);
    EXPECT_FALSE(choice.b);
}

TEST(RemSelection, TakesTheNearestOnTheOtherSideEvenWhenSomethingOnThisSideIsNearer) {
    const RemSet rems{remAt("far ahead", {30, 0, 0}), remAt("ahead", {7, 1, 0}),
                      remAt("nearest", {5, 0, 0}), remAt("behind", {-12, 3, 0}),
                      remAt("far behind", {-40, 0, 0})};
    const RemChoice choice = chooseRems(rems, {0, 0, 0});
    EXPECT_EQ(choice.a, 2u);
    EXPECT_EQ(choice.b, 3u);
}

TEST(RemSelection, TakesTheSecondNearestWhenNoneLiesOnTheOtherSide) {
    const RemSet rems{remAt("c", {9, 2, 0}), remAt("a", {5, 0, 0}), remAt("b", {6, 5, 0})};
    const RemChoice choice = chooseRems(rems, {0, 0, 0});
    EXPECT_EQ(choice.a, 1u);
    EXPECT_EQ(choice.b, 2u);
}

TEST(RemSelection, DoesNotCountARightAngleAsTheOtherSide) {
    const RemSet rems{remAt("a", {1, 0, 0}), remAt("square to it", {0, 2, 0}),
                      remAt("behind", {-9, 0, 0})};
    const RemChoice choice = chooseRems(rems, {0, 0, 0});
    EXPECT_EQ(choice.b, 2u);
}

TEST(RemSelection, BreaksTiesByIdWhateverTheOrder) {
    const RemSet rems{remAt("d", {-5, 0, 0}), remAt("b", {5, 0, 0}), remAt("c", {0, 5, 0}),
                      remAt("a", {0, -5, 0})};
    const RemChoice choice = chooseRems(rems, {0, 0, 0});
    EXPECT_EQ(rems[*choice.a].id, "a");
    EXPECT_EQ(rems[*choice.b].id, "c");  // (0,-5)·(0,5) < 0, the others are square to it
    RemSet reversed;
    for (std::size_t i = rems.size(); i-- > 0;)
        reversed.add(rems.pointers()[i]);
    const RemChoice again = chooseRems(reversed, {0, 0, 0});
    EXPECT_EQ(reversed[*again.a].id, "a");
    EXPECT_EQ(reversed[*again.b].id, "c");
}

TEST(RemSelection, TakesTheSecondNearestWhenThePositionIsTheCentreOfA) {
    const RemSet rems{remAt("far", {-20, 0, 0}), remAt("here", {3, 4, 5}),
                      remAt("near", {10, 0, 0})};
    const RemChoice choice = chooseRems(rems, {3, 4, 5});
    EXPECT_EQ(choice.a, 1u);
    EXPECT_EQ(choice.b, 2u);
}

TEST(RemSelection, ChoosesTwoThatCoincide) {
    const RemSet rems{remAt("b", {1, 1, 1}), remAt("a", {1, 1, 1})};
    const RemChoice choice = chooseRems(rems, {4, 0, 0});
    EXPECT_EQ(choice.a, 1u);
    EXPECT_EQ(choice.b, 0u);
}

TEST(BlendParameter, IsTheClampedProjectionOntoTheAxisOfTheTwoCentres) {
    const glm::dvec3 a(10, 0, 2);
    const glm::dvec3 b(30, 0, 2);
    EXPECT_DOUBLE_EQ(blendParameter(a, b, {15, 40, -7}), 0.25);
    EXPECT_DOUBLE_EQ(blendParameter(a, b, {20, -3, 90}), 0.5);
    EXPECT_DOUBLE_EQ(blendParameter(a, b, {-5, 1, 1}), 0.0);
    EXPECT_DOUBLE_EQ(blendParameter(a, b, {31, 1, 1}), 1.0);
    EXPECT_DOUBLE_EQ(blendParameter({0, 0, 0}, {2, 2, 0}, {1, 0, 5}), 0.25);
}

TEST(BlendParameter, IsZeroWhenTheCentresCoincide) {
    EXPECT_EQ(blendParameter({1, 2, 3}, {1, 2, 3}, {7, 8, 9}), 0.0);
}

TEST(Validity, ComparesTheDistanceMapWithTheDistanceOfThePoint) {
    const ReferenceEnvironmentMap rem = test::plainMap("r", {1, 2, 3}, 8, glm::vec3(1), 10.0f);
    EXPECT_TRUE(isValid(rem, {11, 2, 3}, 0.0));
    EXPECT_TRUE(isValid(rem, {10, 2, 3}, 0.0));
    EXPECT_FALSE(isValid(rem, {11.01, 2, 3}, 0.0));
    EXPECT_TRUE(isValid(rem, {11.01, 2, 3}, 0.02));
    EXPECT_TRUE(isValid(rem, {1, 2, 3}, 0.0)) << "the centre itself";
}

TEST(Validity, NeedsOnlyOneOfTheFourTexelsAroundToSeeThePoint) {
    ReferenceEnvironmentMap rem = test::plainMap("r", {0, 0, 0}, 4, glm::vec3(1), 5.0f);
    rem.distance.at(0, 2, 1) = 20.0f;
    const glm::dvec3 between = faceDirection(0, {0.01, 0.01});  // among columns 1, 2 and rows 1, 2
    const glm::dvec3 elsewhere = faceDirection(0, {-0.6, 0.6});
    EXPECT_TRUE(isValid(rem, 15.0 * between, 0.5));
    EXPECT_FALSE(isValid(rem, 15.0 * elsewhere, 0.5));
}

TEST(Validity, SeesSkyWhereOneOfTheFourTexelsIsInfinite) {
    ReferenceEnvironmentMap rem = test::plainMap("r", {0, 0, 0}, 4, glm::vec3(1), 5.0f);
    rem.distance.at(4, 1, 1) = kInfinity;
    EXPECT_TRUE(isValidSky(rem, faceDirection(4, {-0.1, -0.1})));
    EXPECT_TRUE(isValidSky(rem, faceDirection(4, {0.2, 0.2})));
    EXPECT_FALSE(isValidSky(rem, faceDirection(4, {0.3, 0.3})));
    EXPECT_FALSE(isValidSky(rem, faceDirection(5, {0.0, 0.0})));
}

TEST(Validity, LooksAcrossTheEdgesOfTheCube) {
    ReferenceEnvironmentMap rem = test::plainMap("r", {0, 0, 0}, 4, glm::vec3(1), 5.0f);
    rem.distance.at(4, 3, 1) = kInfinity;  // +Z, its last column: next to +X
    EXPECT_TRUE(isValidSky(rem, faceDirection(0, {-0.99, -0.25})));
    EXPECT_FALSE(isValidSky(rem, faceDirection(0, {+0.99, -0.25})));
}

}  // namespace
}  // namespace reflet
