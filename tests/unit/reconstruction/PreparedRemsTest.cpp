// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemVertexTracer.h"
#include "core/reconstruction/PreparedRems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <thread>

namespace reflet {
namespace {

std::shared_ptr<const HeightfieldTracer> tracerOf(const test::BoxCity& city) {
    return std::make_shared<HeightfieldTracer>(city.heightfield());
}

/// Two streets with a block of houses between; REMs every 6 m in both.
struct TwoStreets {
    test::BoxCity city{-60, -30, 120, 60, 1.0};
    RemSet rems;

    TwoStreets() {
        city.addBox(-60, -4, 60, 4, 30.0F);  // between the streets
        city.addBox(-60, -24, 60, -16, 30.0F);
        city.addBox(-60, 16, 60, 24, 30.0F);
        for (int i = 0; i < 9; ++i) {
            const double x = 6.0 * (i - 4);
            rems.add(city.see("south" + std::to_string(i), {x, -10.0, 2.0}, 32, 1));
            rems.add(city.see("north" + std::to_string(i), {x, 10.0, 2.0}, 32, 1));
        }
    }
};

TEST(PreparedRems, LeaveOutWhatIsNearAndBlindForWhatIsFarAndSees) {
    const TwoStreets streets;
    const auto tracer = tracerOf(streets.city);
    const PreparedRems prepared(tracer, streets.rems);
    MemSettings settings;
    settings.remsPerVehicle = 8;
    // In the south street near the houses between, 18.5 m from the nearest REM of the north street:
    // farther than seven of its own, nearer than two.
    const glm::dvec3 position(0.5, -8.5, 1.7);
    const auto ofTheNorth = [](const RemCandidates& found) {
        return std::count_if(found.rems.begin(), found.rems.end(),
                             [](const RemCandidate& c) { return c.rem % 2 == 1; });
    };
    EXPECT_GE(ofTheNorth(candidateRems(streets.rems, position, settings)), 1);
    const RemCandidates found = prepared.at(position, settings);
    EXPECT_EQ(ofTheNorth(found), 0);
    EXPECT_GE(found.rems.size(), 5U);
}

TEST(PreparedRems, ServeARayAtLeastAsOftenAsTheNearest) {
    const TwoStreets streets;
    const auto tracer = tracerOf(streets.city);
    const PreparedRems prepared(tracer, streets.rems);
    const ReconstructionInput nearest{tracer.get(), streets.rems, 200.0};
    ReconstructionInput bySight = nearest;
    bySight.prepared = &prepared;
    MemSettings settings;
    settings.resolution = 32;
    settings.remsPerVehicle = 4;
    std::size_t withNearest = 0, withPrepared = 0;
    for (const double x : {-9.0, -2.0, 3.5, 8.0}) {
        withNearest += reconstructDense(nearest, {x, -6.0, 1.7}, settings).statistics.uncovered;
        withPrepared += reconstructDense(bySight, {x, -6.0, 1.7}, settings).statistics.uncovered;
    }
    EXPECT_LE(withPrepared, withNearest);
}

TEST(PreparedRems, AreContinuousAlongADrive) {
    const TwoStreets streets;
    const auto tracer = tracerOf(streets.city);
    const PreparedRems prepared(tracer, streets.rems);
    MemSettings settings;
    settings.remsPerVehicle = 5;
    std::map<std::size_t, double> before;
    constexpr double kStep = 0.02;
    for (double x = -20.0; x < 20.0; x += kStep) {
        std::map<std::size_t, double> presence;
        for (const RemCandidate& c : prepared.at({x, -9.0 + 0.1 * x, 1.7}, settings).rems)
            presence[c.rem] = c.presence;
        for (std::size_t i = 0; i < streets.rems.size() && !before.empty(); ++i)
            ASSERT_LT(std::abs(presence[i] - before[i]), 0.03) << "REM " << i << " at " << x;
        before = presence;
    }
}

TEST(PreparedRems, GiveTheSameFromManyThreads) {
    const TwoStreets streets;
    const auto tracer = tracerOf(streets.city);
    const PreparedRems alone(tracer, streets.rems);
    const PreparedRems shared(tracer, streets.rems);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&] {
            for (double x = -10.0; x < 10.0; x += 1.3)
                static_cast<void>(shared.at({x, -9.0, 1.7}, {}));
        });
    }
    for (std::thread& thread : threads)
        thread.join();
    for (double x = -10.0; x < 10.0; x += 1.3)
        EXPECT_EQ(shared.at({x, -9.0, 1.7}, {}).rems, alone.at({x, -9.0, 1.7}, {}).rems);
}

TEST(PreparedRems, KeepTheNearestWhereAllAreBlindAndNoneWhereThereIsNone) {
    const test::BoxCity city(-20, -20, 40, 40, 1.0);
    const auto tracer = tracerOf(city);
    RemSet blind;
    for (const double x : {3.0, 1.0, 9.0})
        blind.add(test::plainMap("r", {x, 0, 2}, 4, glm::vec3(0.5F), 1e-3F));
    const RemCandidates found = PreparedRems(tracer, blind).at({0.0, 0.0, 0.0}, {});
    ASSERT_EQ(found.rems.size(), 1U);
    EXPECT_EQ(found.rems[0], (RemCandidate{1, 1.0}));
    EXPECT_TRUE(PreparedRems(tracer, {}).at({0.3, 0.2, 2.0}, {}).rems.empty());
}

TEST(Candidates, OfWhichTooManyArePresentLoseTheLeastWithoutAJump) {
    RemCandidates many;
    for (std::size_t i = 0; i < kMostCandidates + 3; ++i)
        many.rems.push_back({i, 0.5 - 0.01 * double(i)});
    keepMostPresent(many);
    ASSERT_EQ(many.rems.size(), kMostCandidates);
    const double least = 0.5 - 0.01 * double(kMostCandidates);
    EXPECT_NEAR(many.rems.back().presence, 0.01 / (1.0 - least), 1e-12);
    EXPECT_NEAR(many.rems.front().presence, (0.5 - least) / (1.0 - least), 1e-12);
}

}  // namespace
}  // namespace reflet
