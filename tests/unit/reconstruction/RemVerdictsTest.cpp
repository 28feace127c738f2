// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"
#include "core/reconstruction/RemVerdicts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace reflet {
namespace {

/// A wall along x north of a street, and a screen across the street at x = 20.
class RemVerdictsTest : public testing::Test {
protected:
    RemVerdictsTest() : city(-60.0, -40.0, 120, 80, 1.0) {
        city.addBox(-60.0, 10.0, 60.0, 14.0, 12.0F);
        city.addBox(20.0, -9.0, 22.0, 9.0, 12.0F);
        tracer.emplace(city.heightfield());
        for (const auto& [id, x] : {std::pair{"near", 2.0}, {"aside", -14.0}, {"behind", 26.0}})
            rems.add(std::make_shared<const ReferenceEnvironmentMap>(
                city.see(id, {x, 0.0, 2.0}, 32, 1)));
    }
    [[nodiscard]] DirectionVerdict at(const glm::dvec3& direction) const {
        ReconstructionInput input;
        input.tracer = &*tracer;
        input.rems = rems;
        return explainDirection(input, {0.0, 0.0, 2.0}, direction, {});
    }
    [[nodiscard]] const RemVerdict& of(const DirectionVerdict& verdict, const char* id) const {
        return *std::find_if(verdict.rems.begin(), verdict.rems.end(),
                             [&](const auto& each) { return rems[each.rem].id == id; });
    }

    test::BoxCity city;
    std::optional<HeightfieldTracer> tracer;
    RemSet rems;
};

TEST_F(RemVerdictsTest, TellsWhoShowsAWallAndThatTheOneBehindTheScreenDoesNot) {
    const DirectionVerdict verdict = at({0.0, 2.0, 0.4});
    EXPECT_FALSE(verdict.sky);
    EXPECT_FALSE(verdict.uncovered);
    EXPECT_NEAR(verdict.point.y, 10.0, 0.1);
    ASSERT_EQ(verdict.rems.size(), 3U);
    EXPECT_EQ(rems[verdict.rems.front().rem].id, "near");
    EXPECT_GT(verdict.rems.front().weight, 0.5);
    EXPECT_EQ(of(verdict, "behind").reason, RemVerdict::Reason::Hidden);
    EXPECT_EQ(of(verdict, "behind").weight, 0.0);
    EXPECT_NEAR(of(verdict, "near").angle, std::atan2(2.0, std::hypot(10.0, 2.0)), 0.02);
    double sum = 0.0;
    for (const RemVerdict& each : verdict.rems)
        sum += each.weight;
    EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST_F(RemVerdictsTest, OneThatSeesItFromTheSideLosesByItsAngle) {
    MemSettings one;
    one.remsPerVehicle = 1;
    ReconstructionInput input;
    input.tracer = &*tracer;
    input.rems = rems;
    const DirectionVerdict verdict = explainDirection(input, {0.0, 0.0, 2.0}, {0.0, 1.0, 0.2}, one);
    EXPECT_EQ(of(verdict, "near").reason, RemVerdict::Reason::Shown);
    EXPECT_EQ(of(verdict, "aside").reason, RemVerdict::Reason::Angle);
    EXPECT_GT(of(verdict, "aside").angle, of(verdict, "near").angle);
}

TEST_F(RemVerdictsTest, SaysWhereNobodySees) {
    RemSet blind;
    blind.add(rems.pointers().back());
    ReconstructionInput input;
    input.tracer = &*tracer;
    input.rems = blind;
    const DirectionVerdict verdict =
        explainDirection(input, {-30.0, 0.0, 2.0}, {0.0, 1.0, 0.2}, {});
    EXPECT_TRUE(verdict.uncovered);
    const DirectionVerdict sky = at({0.0, 0.0, 1.0});
    EXPECT_TRUE(sky.sky);
    EXPECT_EQ(sky.rems.front().angle, 0.0);
}

}  // namespace
}  // namespace reflet
