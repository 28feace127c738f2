// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/Service.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reflet::test {
namespace {

/// A wall in the plane y = 10, and a vehicle before it.
DemandSample onWall(double vehicleX, double pointX) {
    DemandSample s;
    s.vehicle = {vehicleX, 0.0, 1.5};
    const glm::dvec3 point(pointX, 10.0, 1.5);
    s.direction = glm::vec3(glm::normalize(point - s.vehicle));
    s.distance = float(glm::distance(point, s.vehicle));
    s.normal = {0.0F, -1.0F, 0.0F};
    s.cell = 0;
    return s;
}

ReferenceEnvironmentMap at(const glm::dvec3& center) {
    ReferenceEnvironmentMap rem;
    rem.center = center;
    return rem;
}

const GridSpec kGrid{-100.0, -100.0, 0.5, 400, 400};

TEST(ServiceTest, ARemWhereTheVehicleIsServesInFull) {
    const ServiceRule rule(kGrid, 128);
    for (const double x : {0.0, 8.0, 40.0})
        EXPECT_DOUBLE_EQ(rule.likeness(onWall(0.0, x), at({0.0, 0.0, 1.5})), 1.0) << x;
}

/// From C = (c, 0) and P = (0, 0) onto I = (0, 10) of the wall: |I − P| = 10, |I − C| = √(100 +
/// c²), cosines 1 and 10 / |I − C|.
TEST(ServiceTest, LosesWhatTheFormulaSays) {
    const ServiceRule rule(kGrid, 128);
    const double texel = std::numbers::pi / 2.0 / 128.0;
    for (const double c : {1.0, 5.0, 15.0, 30.0, 60.0}) {
        const double far = std::hypot(10.0, c);
        const double blur = far / 10.0 * std::sqrt(far / 10.0);
        const double shift = 0.25 * (c / far) / (far * texel);
        const double wanted = std::min(1.0, 4.0 / blur) * std::min(1.0, 4.0 / shift);
        EXPECT_NEAR(rule.likeness(onWall(0.0, 0.0), at({c, 0.0, 1.5})), wanted, 1e-6) << c;
    }
    EXPECT_EQ(rule.likeness(onWall(0.0, 0.0), at({81.0, 0.0, 1.5})), 0.0) << "out of reach";
    EXPECT_EQ(rule.likeness(onWall(0.0, 0.0), at({0.0, 20.0, 1.5})), 0.0) << "behind the wall";
}

TEST(ServiceTest, FallsAsTheRemMovesAway) {
    const ServiceRule rule(kGrid, 128);
    double last = 1.0;
    for (double c = 0.0; c < 80.0; c += 2.0) {
        const double now = rule.likeness(onWall(0.0, 0.0), at({c, 0.0, 1.5}));
        EXPECT_LE(now, last + 1e-12) << c;
        last = now;
    }
    EXPECT_LT(last, 0.5);
}

TEST(ServiceTest, SightIsWhatRaysSee) {
    const BoxCity city = streetCity();
    const HeightfieldTracer tracer(city.heightfield());
    const glm::dvec3 center(3.0, 0.0, 1.7);
    const ReferenceEnvironmentMap seen = city.see("c", center, 32, 1);
    const ReferenceEnvironmentMap sight = sightFrom(tracer, center, 32, "c");
    ASSERT_EQ(sight.distance.resolution(), 32);
    for (std::size_t k = 0; k < seen.distance.texels().size(); ++k) {
        const float wanted = seen.distance.texels()[k];
        const float got = sight.distance.texels()[k];
        if (std::isinf(wanted))
            EXPECT_TRUE(std::isinf(got)) << k;
        else
            EXPECT_NEAR(got, wanted, 1e-3F * wanted) << k;
    }
}

TEST(ServiceTest, WhatARemCannotSeeItDoesNotServe) {
    BoxCity city(-50.0, -50.0, 200, 200, 0.5);
    city.addBox(-50.0, 10.0, 50.0, 12.0, 20.0F);  // the wall
    city.addBox(8.0, 2.0, 9.0, 9.0, 20.0F);       // what hides a part of it from the east
    const HeightfieldTracer tracer(city.heightfield());
    const ServiceRule rule(city.heightfield().grid, 128);
    const DemandSample sample = onWall(0.0, 1.0);
    EXPECT_GT(rule.service(sample, sightFrom(tracer, {-8.0, 0.0, 1.5}, 128)), 0.5);
    EXPECT_EQ(rule.service(sample, sightFrom(tracer, {18.0, 7.0, 1.5}, 128)), 0.0);

    DemandSample sky;
    sky.vehicle = {0.0, 0.0, 1.5};
    sky.direction = glm::vec3(glm::normalize(glm::vec3(0.0F, -1.0F, 1.0F)));
    sky.distance = INFINITY;
    EXPECT_EQ(rule.service(sky, sightFrom(tracer, {-8.0, 0.0, 1.5}, 128)), 1.0);
    sky.direction = glm::vec3(glm::normalize(glm::vec3(0.0F, 1.0F, 1.0F)));
    EXPECT_EQ(rule.service(sky, sightFrom(tracer, {-8.0, 0.0, 1.5}, 128)), 0.0)
        << "the wall stands there";
}

TEST(ServiceTest, TheIndexFindsAllWithinReach) {
    Demand demand;
    for (int i = 0; i < 500; ++i) {
        DemandSample s;
        s.vehicle = {double(i * 37 % 400) - 200.0, double(i * 61 % 300) - 150.0, 1.0};
        demand.samples.push_back(s);
    }
    const SampleIndex index(demand);
    for (const glm::dvec3& center :
         {glm::dvec3(0, 0, 1), glm::dvec3(-230, 100, 1), glm::dvec3(1e6, 0, 1)}) {
        std::vector<std::uint32_t> wanted;
        for (std::size_t i = 0; i < demand.samples.size(); ++i) {
            if (glm::distance(demand.samples[i].vehicle, center) <= ServiceRule::kReach)
                wanted.push_back(std::uint32_t(i));
        }
        std::vector<std::uint32_t> found = index.within(center);
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, wanted);
    }
    EXPECT_TRUE(SampleIndex(Demand{}).within({0, 0, 0}).empty());
}

}  // namespace
}  // namespace reflet::test
