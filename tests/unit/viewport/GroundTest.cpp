// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/BoxCity.h"
#include "widgets/viewport/camera/Ground.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

using test::BoxCity;

Ray towards(const glm::dvec3& from, const glm::dvec3& to) {
    return {from, glm::normalize(to - from)};
}

TEST(Ground, WithoutACityIsLevelAtZero) {
    const Ground ground;
    EXPECT_EQ(ground.heightAt(123, -5), 0.0);
    EXPECT_FALSE(ground.isSolid(0, 0));
    const auto point = ground.pointUnder(towards({0, 0, 10}, {3, 4, 0}));
    ASSERT_TRUE(point);
    EXPECT_LT(glm::distance(*point, glm::dvec3(3, 4, 0)), 1e-9);
    EXPECT_FALSE(ground.pointUnder(towards({0, 0, 10}, {3, 4, 20})));
}

TEST(Ground, FindsWhereARayMeetsTheStreet) {
    const Ground ground(BoxCity::make());
    const auto point = ground.streetUnder(towards({0, -20, 10}, {-7, 3, 0}));
    ASSERT_TRUE(point);
    EXPECT_LT(glm::distance(*point, glm::dvec3(-7, 3, 0)), 1e-6);
}

TEST(Ground, TakesTheFootOfAWallForTheStreet) {
    const Ground ground(BoxCity::make());
    const auto point = ground.streetUnder(towards({20, -20, 5}, {20, 10, 6}));
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->x, 20.0, 1e-6);
    EXPECT_NEAR(point->y, 10.0, 1e-6);
    EXPECT_NEAR(point->z, 0.0, 1e-6);
}

TEST(Ground, PutsAProbeOverTheStreetBeforeAWallAndOverARoof) {
    const Ground ground(BoxCity::make());
    const auto street = ground.probePlaceUnder(towards({0, -20, 10}, {-7, 3, 0}));
    ASSERT_TRUE(street);
    EXPECT_LT(glm::distance(*street, glm::dvec3(-7, 3, kProbeHeight)), 1e-6);

    const auto wall = ground.probePlaceUnder(towards({20, -20, 5}, {20, 10, 6}));
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->y, 10.0 - 0.5 - BoxCity::kCell, 1e-6);
    EXPECT_NEAR(wall->z, kProbeHeight, 1e-6);
    EXPECT_FALSE(ground.isSolid(wall->x, wall->y));

    const auto roof = ground.probePlaceUnder(towards({20, -5, 40}, {20, 15, 12}));
    ASSERT_TRUE(roof);
    EXPECT_NEAR(roof->z, BoxCity::kHouseHeight + kProbeHeight, 1e-6);
}

TEST(Ground, FollowsASlopeWithAPointThatIsDragged) {
    const Ground ground(BoxCity::make([](double x, double) { return 0.1 * x; }));
    const Ray ray = towards({0, -30, 20}, {-10, 0, 1});
    const auto place = draggedOverGround(ground, ray, {0, 0, 2}, 2.0);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->z, ground.heightAt(place->x, place->y) + 2.0, 1e-6);
    // The point lies where the ray is, to the size of a slope's remaining step.
    const double t = (place->y - ray.origin.y) / ray.direction.y;
    EXPECT_LT(glm::distance(ray.at(t), *place), 0.05);
}

TEST(Ground, SaysThatNothingIsDraggedToTheSky) {
    const Ground ground(BoxCity::make());
    EXPECT_FALSE(draggedOverGround(ground, towards({0, 0, 5}, {0, 10, 9}), {0, 3, 1}, 1.0));
    EXPECT_FALSE(draggedOverGround(ground, towards({0, 0, 5}, {0, 10, 5}), {0, 3, 1}, 1.0));
}

TEST(Ground, DragsAPointUpToWhereTheRayPassesItsVertical) {
    EXPECT_NEAR(draggedVertically(towards({0, -10, 5}, {0, 0, 8}), {0, 0, 1}), 8.0, 1e-9);
    EXPECT_NEAR(draggedVertically({{0, 0, 5}, {0, 0, -1}}, {0, 0, 1}), 1.0, 1e-9);
}

TEST(Ground, KnowsWhatStandsInTheWayAndWhereTheCityEnds) {
    const Ground ground(BoxCity::make());
    EXPECT_TRUE(ground.isSolid(20, 15));
    EXPECT_FALSE(ground.isSolid(0, 0));
    EXPECT_TRUE(ground.isSolid(500, 0));
    EXPECT_TRUE(std::isnan(ground.heightAt(500, 0)));
    EXPECT_EQ(ground.heightNear(500, 0), 0.0);
    EXPECT_NEAR(ground.bounds().max.z, BoxCity::kHouseHeight, 1e-6);
}

TEST(Ground, BearsACityWithoutAHeightfield) {
    const Ground ground(std::make_shared<const DrawnCity>());
    EXPECT_EQ(ground.heightAt(0, 0), 0.0);
    EXPECT_TRUE(ground.bounds().empty());
}

TEST(Ground, UnderABridgeIsTheStreet) {
    const auto plain = BoxCity::make();
    auto field = std::make_shared<Heightfield>(*plain->heightfield);
    // A slab from 5 m to 6 m over x from -30 m to -20 m.
    std::vector<std::uint32_t> cells, first{0};
    std::vector<HeightSpan> spans;
    for (std::size_t cell = 0; cell < field->grid.cellCount(); ++cell) {
        const double x = field->grid.xMin(int(cell % std::size_t(field->grid.columns)));
        if (x < -30.0 || x >= -20.0)
            continue;
        spans.push_back({-kInfinity, 0.0F, CityObjectType::TinRelief, false});
        spans.push_back({5.0F, 6.0F, CityObjectType::Bridge, false});
        first.push_back(std::uint32_t(spans.size()));
        cells.push_back(std::uint32_t(cell));
        field->topCenter[cell] = 6.0F;
    }
    field->centerSpans = CellSpans(field->grid.cellCount(), cells, first, spans);
    auto city = std::make_shared<DrawnCity>(*plain);
    city->tracer = std::make_shared<const HeightfieldTracer>(*field);
    city->heightfield = field;
    const Ground ground(city);
    EXPECT_FALSE(ground.isSolid(-25, 0));
    const auto street = ground.streetUnder(towards({-40, 0, 2}, {-25, 0, 0}));
    ASSERT_TRUE(street);
    EXPECT_LT(glm::distance(*street, glm::dvec3(-25, 0, 0)), 1e-6);
    const auto probe = ground.probePlaceUnder(towards({-40, 0, 2}, {-25, 0, 0}));
    ASSERT_TRUE(probe);
    EXPECT_LT(glm::distance(*probe, glm::dvec3(-25, 0, 1.75)), 1e-6);
    const auto deck = ground.pointUnder(towards({-40, 0, 20}, {-25, 0, 6}));
    ASSERT_TRUE(deck);
    EXPECT_NEAR(deck->z, 6.0, 1e-6);
}

}  // namespace
}  // namespace reflet
