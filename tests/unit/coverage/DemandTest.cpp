// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/coverage/Demand.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reflet::test {
namespace {

class DemandTest : public testing::Test {
protected:
    static DemandLine line(std::vector<glm::dvec3> points, double weight = 1.0) {
        return {"line", std::make_shared<Route>(std::move(points)), car(), weight};
    }
    static std::shared_ptr<const BodyReflections> car() {
        static const auto made = std::make_shared<const BodyReflections>(*builtInVehicle("car"));
        return made;
    }
    BoxCity plain{-200.0, -200.0, 400, 400, 1.0};
};

TEST_F(DemandTest, MeetsThePlaneWhereGeometrySays) {
    const HeightfieldTracer tracer(plain.heightfield());
    const Demand demand = sampleDemand(tracer, {line({{-50, 0, 0}, {50, 0, 0}})}, {}, 4000, 1);
    ASSERT_EQ(demand.samples.size(), 4000U);
    std::size_t sky = 0;
    for (const DemandSample& s : demand.samples) {
        EXPECT_NEAR(s.vehicle.z, car()->centerHeight(), 1e-9);
        EXPECT_NEAR(s.vehicle.y, 0.0, 1e-9);
        EXPECT_NEAR(s.vehicle.x, double(s.station) - 50.0, 1e-3);
        sky += s.sky() ? 1 : 0;
        if (s.sky()) {
            EXPECT_GT(s.direction.z, -0.02F) << "the plane ends after 150 m";
            continue;
        }
        EXPECT_NEAR(double(s.distance), -s.vehicle.z / double(s.direction.z), 1e-3);
        EXPECT_NEAR(s.normal.z, 1.0F, 1e-6F);
        EXPECT_NEAR(s.point().z, 0.0, 1e-3);
    }
    EXPECT_GT(sky, 400U);
    EXPECT_LT(sky, 3600U);
}

TEST_F(DemandTest, ALineCountsByItsLengthAndWeight) {
    const HeightfieldTracer tracer(plain.heightfield());
    const auto lines = {line({{-50, 0, 0}, {50, 0, 0}}), line({{0, 20, 0}, {0, 70, 0}}, 4.0)};
    const Demand demand = sampleDemand(tracer, lines, {}, 3200, 1);
    std::size_t second = 0;
    for (const DemandSample& s : demand.samples)
        second += s.line == 1 ? 1 : 0;
    EXPECT_NEAR(double(second) / 3200.0, 200.0 / 300.0, 0.01);
}

TEST_F(DemandTest, MoreSamplesBeginWithTheSameAndThreadsChangeNothing) {
    const HeightfieldTracer tracer(plain.heightfield());
    const auto lines = {line({{-50, 0, 0}, {50, 0, 0}})};
    const Demand few = sampleDemand(tracer, lines, {}, 320, 9);
    setThreadLimit(1);
    const Demand many = sampleDemand(tracer, lines, {}, 1000, 9);
    setThreadLimit(0);
    ASSERT_EQ(many.samples.size(), 1008U) << "a multiple of the runs";
    for (std::size_t i = 0; i < few.samples.size(); ++i) {
        EXPECT_EQ(few.samples[i].direction, many.samples[i].direction);
        EXPECT_EQ(few.samples[i].distance, many.samples[i].distance);
    }
    const Demand other = sampleDemand(tracer, lines, {}, 320, 10);
    EXPECT_NE(few.samples[0].direction, other.samples[0].direction);
}

TEST_F(DemandTest, OnlookersAtAViewCountWhereTheyAreNear) {
    const HeightfieldTracer tracer(plain.heightfield());
    // Somebody high above, over the east end: to him the sides of a car, which mirror most at their
    // grazing angles, show the ground.
    const Onlookers above{{{50.0, 0.0, 60.0}}, 80.0};
    const Demand demand = sampleDemand(tracer, {line({{-150, 0, 0}, {50, 0, 0}})}, above, 8000, 1);
    double near = 0.0, far = 0.0;
    std::size_t nearCount = 0, farCount = 0;
    for (const DemandSample& s : demand.samples) {
        if (s.vehicle.x > 20.0) {
            near += s.sky() ? 1.0 : 0.0;
            ++nearCount;
        } else if (s.vehicle.x < -20.0) {
            far += s.sky() ? 1.0 : 0.0;
            ++farCount;
        }
    }
    EXPECT_LT(near / double(nearCount), far / double(farCount) - 0.05);
}

TEST_F(DemandTest, NothingIsAskedForWhereThereIsNoLine) {
    const HeightfieldTracer tracer(plain.heightfield());
    EXPECT_TRUE(sampleDemand(tracer, std::vector<DemandLine>{}, {}, 100, 1).samples.empty());
    EXPECT_TRUE(sampleDemand(tracer, DemandGround{}, {}, 100, 1).samples.empty());
    const DemandGround ground{{{0, 0, 0}, {10, 0, 0}}, 1.0, car()};
    const Demand demand = sampleDemand(tracer, ground, {}, 160, 1);
    EXPECT_EQ(demand.samples.size(), 160U);
}

TEST_F(DemandTest, TheStatedErrorHolds) {
    // A value that is known: the share of a wave over the samples' directions.
    const HeightfieldTracer tracer(plain.heightfield());
    const auto lines = {line({{-50, 0, 0}, {50, 0, 0}})};
    const auto valuesOf = [&](std::size_t count, std::uint64_t seed) {
        std::vector<float> values;
        for (const DemandSample& s : sampleDemand(tracer, lines, {}, count, seed).samples)
            values.push_back(s.sky() ? 1.0F : std::sin(s.station) * 0.5F + 0.5F);
        return values;
    };
    const double truth = estimateOf(valuesOf(400'000, 1234)).mean;
    int inside = 0;
    constexpr int trials = 60;
    for (int seed = 0; seed < trials; ++seed) {
        const Estimate estimate = estimateOf(valuesOf(1600, std::uint64_t(seed)));
        inside += std::abs(estimate.mean - truth) <= estimate.error ? 1 : 0;
        EXPECT_LT(estimate.error, 0.05);
    }
    // 95 of 100 are promised; of 60, at least 51 in all but one of 1,000 series.
    EXPECT_GE(inside, 51);
    EXPECT_EQ(estimateOf({}).mean, 0.0);
}

TEST(SurfaceNormalTest, AnObliqueWallIsNoStair) {
    // A wall along y = x, as cells: high where y > x.
    BoxCity city(-20.0, -20.0, 160, 160, 0.25);
    for (int k = 0; k < 160; ++k)
        city.addBox(-20.0 + 0.25 * k, -20.0 + 0.25 * k, -20.0 + 0.25 * (k + 1), 20.0, 10.0F);
    const HeightfieldTracer tracer(city.heightfield());
    const glm::dvec3 from(8.0, -8.0, 2.0);
    const glm::dvec3 wanted = glm::normalize(glm::dvec3(1.0, -1.0, 0.0));
    for (double a = -0.5; a <= 0.5; a += 0.05) {
        const glm::dvec3 direction = glm::normalize(glm::dvec3(-1.0 + a, 1.0 + a, 0.1));
        const HeightfieldHit hit = tracer.trace({from, direction});
        ASSERT_TRUE(hit.hit);
        const auto cell = std::uint32_t(tracer.grid().index(hit.i, hit.j));
        const glm::vec3 normal = surfaceNormal(tracer, cell, from + hit.t * direction, from);
        EXPECT_GT(glm::dot(glm::dvec3(normal), wanted), 0.97) << a;
    }
}

}  // namespace
}  // namespace reflet::test
