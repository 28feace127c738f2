// SPDX-License-Identifier: GPL-3.0-or-later
// Chosen places and their certificate against all sets there are.
#include "core/base/ParallelFor.h"
#include "core/coverage/Placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <random>

namespace reflet {
namespace {

/// Rows that serve a random part of the samples, or all near the row's place on a line.
ServiceTable randomTable(unsigned seed, std::size_t rows, std::size_t samples, bool local) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    ServiceTable table;
    table.samples = samples;
    for (std::size_t row = 0; row < rows; ++row) {
        ServiceRow made;
        const double place = double(samples) * unit(random);
        for (std::size_t i = 0; i < samples; ++i) {
            const double away = std::abs(place - double(i)) / double(samples);
            const double service = local ? std::max(0.0, 1.0 - 5.0 * away) : unit(random);
            if (service > 0.0 && unit(random) < (local ? 0.8 : 0.3))
                made.entries.push_back({std::uint32_t(i), float(service)});
        }
        table.rows.push_back(std::move(made));
    }
    return table;
}

/// f as it is defined.
double worthByDefinition(const ServiceTable& table, const std::vector<std::size_t>& places,
                         double secondShare) {
    double sum = 0.0;
    for (std::size_t i = 0; i < table.samples; ++i) {
        std::vector<double> services{0.0, 0.0};
        for (const std::size_t row : places) {
            for (const auto& entry : table.rows[row].entries) {
                if (entry.sample == i)
                    services.push_back(double(entry.service));
            }
        }
        std::sort(services.begin(), services.end(), std::greater<>());
        sum += (1.0 - secondShare) * services[0] + secondShare * services[1];
    }
    return sum / double(table.samples);
}

std::vector<std::size_t> rowsOf(unsigned mask) {
    std::vector<std::size_t> rows;
    for (unsigned bit = 0; bit < 32; ++bit) {
        if ((mask >> bit & 1U) != 0)
            rows.push_back(bit);
    }
    return rows;
}

/// The most that the fixed places and `count` others are worth, by trying all.
double bestByTrying(const ServiceTable& table, unsigned fixed, std::size_t count,
                    double secondShare) {
    double best = 0.0;
    for (unsigned mask = 0; mask < 1U << table.rows.size(); ++mask) {
        if ((mask & fixed) != 0 || std::size_t(std::popcount(mask)) != count)
            continue;
        best = std::max(best, worthOf(table, rowsOf(mask | fixed), secondShare));
    }
    return best;
}

std::vector<std::size_t> orderOf(const Placement& placement) {
    std::vector<std::size_t> order;
    for (const PlacedRow& placed : placement.chosen)
        order.push_back(placed.row);
    return order;
}

TEST(PlacementTest, WorthIsAsDefined) {
    const ServiceTable table = randomTable(1, 9, 40, false);
    for (const unsigned mask : {0U, 1U, 0b101U, 0b111111111U, 0b10010010U}) {
        for (const double share : {0.0, 0.1, 0.5}) {
            EXPECT_NEAR(worthOf(table, rowsOf(mask), share),
                        worthByDefinition(table, rowsOf(mask), share), 1e-9)
                << mask << " " << share;
        }
    }
}

TEST(PlacementTest, NoSetExceedsTheBoundAndTheChosenOneIsNearIt) {
    double ratios = 0.0, optima = 0.0;
    int cases = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        const std::size_t rows = 8 + seed % 6;
        const ServiceTable table = randomTable(seed, rows, 60, seed % 2 == 0);
        const unsigned fixed = seed % 3 == 0 ? 0b10U : 0U;
        const std::vector<std::size_t> fixedRows = rowsOf(fixed);
        for (const std::size_t count : {1U, 2U, 4U}) {
            PlacementGoal goal;
            goal.count = count;
            const auto placed = place(table, fixedRows, goal, {});
            ASSERT_TRUE(placed);
            const double best = bestByTrying(table, fixed, count, kSecondShare);
            EXPECT_LE(placed->worth, best + 1e-6) << seed;
            EXPECT_NEAR(placed->worth,
                        worthByDefinition(table, placed->all(fixedRows), kSecondShare), 1e-6);
            const auto bound = certify(table, fixedRows, orderOf(*placed), count, kSecondShare, {});
            ASSERT_TRUE(bound);
            EXPECT_GE(bound->prefix, best - 1e-6) << seed << " " << count;
            EXPECT_GE(bound->everything, best - 1e-6) << seed << " " << count;
            EXPECT_GE(bound->dual, best - 1e-6) << seed << " " << count;
            ratios += placed->worth / bound->upperBound();
            optima += placed->worth / best;
            ++cases;
        }
    }
    // How near they are is a matter of these tables, but a bound that says nothing would show.
    EXPECT_GT(ratios / cases, 0.97);
    EXPECT_GT(optima / cases, 0.995);
}

TEST(PlacementTest, TheDualSaysMoreThanTheGains) {
    const ServiceTable table = randomTable(4, 60, 400, true);
    PlacementGoal goal;
    goal.count = 8;
    const auto placed = place(table, {}, goal, {});
    ASSERT_TRUE(placed);
    const auto bound = certify(table, {}, orderOf(*placed), 8, kSecondShare, {});
    ASSERT_TRUE(bound);
    EXPECT_LT(bound->dual, bound->prefix);
    EXPECT_GT(placed->worth / bound->upperBound(), 0.95);
}

TEST(PlacementTest, ACoverageIsReachedWithFewAndNoFewerThanTheBoundSays) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        const ServiceTable table = randomTable(seed, 11, 60, true);
        const double all = worthOf(table, rowsOf((1U << 11U) - 1U), 0.0);
        PlacementGoal goal;
        goal.coverage = 0.8 * all;
        const auto placed = place(table, {}, goal, {});
        ASSERT_TRUE(placed);
        EXPECT_TRUE(placed->reached) << seed;
        EXPECT_GE(placed->coverage, 0.8 * all) << seed;
        // The last one is needed: nothing can be given back.
        for (std::size_t k = 0; k < placed->chosen.size(); ++k) {
            std::vector<std::size_t> fewer = orderOf(*placed);
            fewer.erase(fewer.begin() + std::ptrdiff_t(k));
            EXPECT_LT(worthOf(table, fewer, 0.0), 0.8 * all) << seed;
        }
        std::size_t least = placed->chosen.size();
        for (unsigned mask = 0; mask < 1U << 11U; ++mask) {
            if (worthOf(table, rowsOf(mask), 0.0) >= 0.8 * all)
                least = std::min(least, std::size_t(std::popcount(mask)));
        }
        const auto bound =
            leastCount(table, {}, orderOf(*placed), 0.8 * all, placed->chosen.size(), {});
        ASSERT_TRUE(bound);
        EXPECT_LE(*bound, least) << seed;
        EXPECT_GE(*bound + 1, least) << seed << ": the bound says little";
    }
}

TEST(PlacementTest, GainsAreToldInTheOrderOfChoiceAndAddUp) {
    const ServiceTable table = randomTable(9, 30, 200, true);
    PlacementGoal goal;
    goal.count = 6;
    const std::vector<std::size_t> fixed{3, 7};
    const auto placed = place(table, fixed, goal, {});
    ASSERT_TRUE(placed);
    ASSERT_EQ(placed->chosen.size(), 6U);
    double sum = worthOf(table, fixed, kSecondShare);
    double last = 1.0;
    for (const PlacedRow& one : placed->chosen) {
        EXPECT_LE(one.gain, last + 1e-9);
        EXPECT_NE(one.row, 3U);
        EXPECT_NE(one.row, 7U);
        last = one.gain;
        sum += one.gain;
    }
    EXPECT_NEAR(sum, placed->worth, 1e-6);
    EXPECT_NEAR(placed->chosen.back().coverage, placed->coverage, 1e-9);
    EXPECT_NEAR(placed->before, worthOf(table, fixed, 0.0), 1e-6);
}

TEST(PlacementTest, ThreadsChangeNothing) {
    const ServiceTable table = randomTable(5, 80, 500, true);
    PlacementGoal goal;
    goal.coverage = 0.85;
    setThreadLimit(1);
    const auto one = place(table, {}, goal, {});
    ASSERT_TRUE(one);
    const auto oneBound = certify(table, {}, orderOf(*one), 5, kSecondShare, {});
    setThreadLimit(0);
    const auto many = place(table, {}, goal, {});
    ASSERT_TRUE(many);
    const auto manyBound = certify(table, {}, orderOf(*many), 5, kSecondShare, {});
    EXPECT_EQ(orderOf(*one), orderOf(*many));
    EXPECT_EQ(one->coverage, many->coverage);
    ASSERT_TRUE(oneBound && manyBound);
    EXPECT_EQ(oneBound->dual, manyBound->dual);
    EXPECT_EQ(oneBound->prefix, manyBound->prefix);
}

TEST(PlacementTest, WhatCannotBeReachedIsToldWithTheBestThereIs) {
    const ServiceTable table = randomTable(2, 10, 50, true);
    PlacementGoal goal;
    goal.coverage = 1.0;
    const auto placed = place(table, {}, goal, {});
    ASSERT_TRUE(placed);
    EXPECT_FALSE(placed->reached);
    EXPECT_NEAR(placed->coverage, worthOf(table, rowsOf(0x3ff), 0.0), 1e-6);

    const auto nothing = place(ServiceTable{}, {}, goal, {});
    ASSERT_TRUE(nothing);
    EXPECT_FALSE(nothing->reached);
    EXPECT_TRUE(nothing->chosen.empty());
}

TEST(PlacementTest, CanBeCancelled) {
    std::stop_source stop;
    stop.request_stop();
    const JobContext job({}, stop.get_token());
    const ServiceTable table = randomTable(2, 10, 50, true);
    PlacementGoal goal;
    goal.count = 3;
    const auto placed = place(table, {}, goal, job);
    ASSERT_FALSE(placed);
    EXPECT_EQ(placed.error().code, ErrorCode::Cancelled);
    EXPECT_FALSE(certify(table, {}, {}, 3, 0.0, job));
}

}  // namespace
}  // namespace reflet
