// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/DetailPlanner.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace reflet {
namespace {

/// A street along x, 14 m wide, and a cross street at x = 40 behind the corner house.
std::shared_ptr<const DrawnCity> corner() {
    test::BoxCity city(-100.0, -100.0, 400, 400, 0.5);
    city.addBox(-60.0, 7.0, 30.0, 60.0, 15.0F);
    city.addBox(-60.0, -60.0, 90.0, -7.0, 15.0F);
    auto drawn = std::make_shared<DrawnCity>();
    drawn->heightfield = std::make_shared<const Heightfield>(city.heightfield());
    drawn->tracer = std::make_shared<const HeightfieldTracer>(*drawn->heightfield);
    return drawn;
}

DetailPlanner::Body car(const char* name, const glm::dvec3& at, double pixels) {
    DetailPlanner::Body body{name, 0, at + glm::dvec3(0.0, 0.0, 0.8), {}, pixels, 0.8, 1.0};
    body.bounds.add(at - glm::dvec3(2.2, 0.9, 0.0));
    body.bounds.add(at + glm::dvec3(2.2, 0.9, 1.5));
    return body;
}

class DetailPlannerTest : public testing::Test {
protected:
    void SetUp() override { planner.setCity(corner()); }
    std::vector<DetailPlanner::Choice> plan(const std::vector<DetailPlanner::Body>& bodies) {
        return planner.plan(bodies, {0.0, 0.0, 1.7}, tuned, false);
    }
    DetailPlanner planner;
    MemSettings tuned;
};

TEST_F(DetailPlannerTest, LeavesOutWhatIsBehindTheCornerAndNothingElse) {
    const std::vector<DetailPlanner::Body> bodies{car("near", {20.0, 2.0, 0.0}, 300.0),
                                                  car("behind", {42.0, 40.0, 0.0}, 120.0),
                                                  car("crossing", {42.0, 4.0, 0.0}, 120.0)};
    // What is hidden is worked out in the background.
    auto choices = plan(bodies);
    for (int k = 0; k < 2000 && !choices[1].hidden; ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        choices = plan(bodies);
    }
    EXPECT_FALSE(choices[0].hidden);
    EXPECT_TRUE(choices[1].hidden);
    EXPECT_FALSE(choices[2].hidden);
}

TEST_F(DetailPlannerTest, ShowsWhatMattersAndWhatIsLargeFiner) {
    auto near = car("near", {10.0, 2.0, 0.0}, 400.0);
    auto far = car("far", {60.0, 0.0, 0.0}, 20.0);
    auto important = far;
    important.reflector = "important";
    important.interest = 5.0;
    const auto choices = plan({near, far, important});
    EXPECT_EQ(choices[0].detail.resolution, tuned.resolution);
    EXPECT_TRUE(choices[1].detail.blend);
    EXPECT_FALSE(choices[2].detail.blend);
    EXPECT_GT(choices[2].weight, choices[1].weight);
}

TEST_F(DetailPlannerTest, LetsMapsServeLongerWhereNothingIsNear) {
    auto street = car("street", {0.0, 4.0, 0.0}, 400.0);
    auto field = car("field", {80.0, 60.0, 0.0}, 400.0);
    const auto choices = plan({street, field});
    EXPECT_TRUE(choices[0].detail.sameQuality(choices[1].detail));
    EXPECT_GT(choices[1].detail.reuse, 2.0 * choices[0].detail.reuse);
}

TEST_F(DetailPlannerTest, GivesWayWhenMapsAreDearAndForgetsWithTheCity) {
    tuned.lod.frameBudget = 20.0;
    std::vector<DetailPlanner::Body> bodies;
    for (int k = 0; k < 12; ++k)
        bodies.push_back(car(std::to_string(k).c_str(), {5.0 + 4.0 * k, 2.0, 0.0}, 200.0));
    for (int frame = 0; frame < 20; ++frame) {
        for (DetailPlanner::Body& body : bodies)
            body.center.x += 0.3;
        static_cast<void>(plan(bodies));
        planner.budget().took(18.0, {8.0, 40'000.0});
    }
    EXPECT_GT(planner.budget().coarse(), 0);
    planner.setCity(corner());
    EXPECT_EQ(planner.budget().coarse(), 0);
}

TEST(DetailPlannerWithoutACity, ChoosesBySizeAlone) {
    DetailPlanner planner;
    const DetailPlanner::Body one = car("one", {10.0, 0.0, 0.0}, 500.0);
    const auto choices = planner.plan({&one, 1}, glm::dvec3(0.0), {}, false);
    ASSERT_EQ(choices.size(), 1U);
    EXPECT_FALSE(choices[0].hidden);
    EXPECT_EQ(choices[0].detail.resolution, MemSettings{}.resolution);
}

}  // namespace
}  // namespace reflet
