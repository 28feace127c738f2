// SPDX-License-Identifier: GPL-3.0-or-later
// Coverage and suggestions on a street of twelve houses, 60 m long.
#include "app/pipeline/coverage/CoverageReport.h"
#include "app/pipeline/coverage/CoverageWatch.h"
#include "app/pipeline/coverage/Suggest.h"
#include "core/base/ParallelFor.h"
#include "tests/support/StreetProject.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

class SuggestTest : public testing::Test {
protected:
    SuggestTest() {
        file = folder.path() / "street.reflet";
        EXPECT_TRUE(test::importStreetWithCar(folder, file));
        auto opened = PreparedCity::open(file, {});
        EXPECT_TRUE(opened) << opened.error().message();
        city = std::make_shared<const PreparedCity>(std::move(*opened));
    }
    /// The same with other contents of the project.
    [[nodiscard]] PreparedCity with(const Project& project) const {
        auto updated = city->updated(project, file, {});
        EXPECT_TRUE(updated);
        return *updated;
    }
    [[nodiscard]] glm::dvec3 onRoad(double along, double aside = 0.0) const {
        return {690'000.0 + along, 5'335'000.0 + aside, 1.75};
    }
    static SuggestOptions options() {
        SuggestOptions options;
        options.mostSamples = 16'384;
        return options;
    }

    test::TemporaryFolder folder;
    std::filesystem::path file;
    std::shared_ptr<const PreparedCity> city;
};

TEST_F(SuggestTest, ReachesWhatIsAskedForWithinItsBounds) {
    SuggestOptions asked = options();
    asked.coverage = 0.9;
    const auto suggestion = suggestProbes(*city, asked, {});
    ASSERT_TRUE(suggestion) << suggestion.error().message();
    EXPECT_TRUE(suggestion->reached);
    ASSERT_FALSE(suggestion->probes.empty());
    EXPECT_EQ(suggestion->before.mean, 0.0);
    EXPECT_GE(suggestion->optimised, 0.9);
    EXPECT_NEAR(suggestion->after.mean, suggestion->optimised, 0.03);
    EXPECT_LE(suggestion->optimised, suggestion->coverageBound + 1e-9);
    EXPECT_LE(suggestion->worth, suggestion->worthBound + 1e-9);
    EXPECT_GT(suggestion->ratio(), 0.9);
    EXPECT_LE(suggestion->fewest, suggestion->probes.size());
    EXPECT_GE(suggestion->fewest, 1U);
    EXPECT_LE(suggestion->shown, suggestion->after.mean + 0.02);
    ASSERT_TRUE(suggestion->baselines.uniform);
    EXPECT_LE(*suggestion->baselines.uniform, suggestion->coverageBound + 0.02);
    for (const SuggestedProbe& probe : suggestion->probes) {
        EXPECT_FALSE(probe.reason.empty());
        EXPECT_EQ(probe.routes, std::vector<std::string>{"street"});
        EXPECT_NEAR(probe.position.y, 5'335'000.0, 0.01) << "on the route";
        EXPECT_GT(probe.gain, 0.0);
    }
    // Put into the project, they are what the report says.
    const Project accepted = withSuggested(city->project(), *suggestion);
    EXPECT_EQ(accepted.probes.size(), suggestion->probes.size());
    const auto report = reportCoverage(with(accepted), {}, {});
    ASSERT_TRUE(report);
    EXPECT_NEAR(report->coverage.mean, suggestion->after.mean,
                report->coverage.error + suggestion->after.error + 0.01);
    EXPECT_LE(report->coverage.error, 0.005);
}

TEST_F(SuggestTest, IsTheSameForASeedWithAnyNumberOfThreads) {
    SuggestOptions asked = options();
    asked.count = 3;
    setThreadLimit(1);
    const auto one = suggestProbes(*city, asked, {});
    setThreadLimit(0);
    const auto many = suggestProbes(*city, asked, {});
    ASSERT_TRUE(one && many);
    ASSERT_EQ(one->probes.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(one->probes[i].position, many->probes[i].position);
        EXPECT_EQ(one->probes[i].gain, many->probes[i].gain);
        EXPECT_EQ(one->probes[i].reason, many->probes[i].reason);
    }
    EXPECT_EQ(one->after.mean, many->after.mean);
    EXPECT_EQ(one->worthBound, many->worthBound);
    EXPECT_EQ(one->baselines.random, many->baselines.random);
}

TEST_F(SuggestTest, KeepsWhatStandsThereAndCompletesIt) {
    Project project = city->project();
    project.probes.push_back({"west", onRoad(12.0), std::nullopt, true});
    project.probes.push_back({"s001", onRoad(13.0), std::nullopt, false});
    const PreparedCity placed = with(project);
    SuggestOptions asked = options();
    asked.coverage = 0.85;
    const auto suggestion = suggestProbes(placed, asked, {});
    ASSERT_TRUE(suggestion);
    EXPECT_GT(suggestion->before.mean, 0.2);
    EXPECT_TRUE(suggestion->reached);
    for (const SuggestedProbe& probe : suggestion->probes) {
        EXPECT_NE(probe.id, "s001") << "the name is taken";
        EXPECT_GT(probe.position.x, 690'020.0) << "the west has its probe";
    }
    // Two side by side are one too many: moving the free one helps, the locked one stays.
    ASSERT_FALSE(suggestion->moves.empty());
    EXPECT_EQ(suggestion->moves[0].id, "s001");
    EXPECT_GT(suggestion->moves[0].gain, 0.02);
    EXPECT_GT(suggestion->moves[0].to.x, 690'025.0);

    asked.afresh = true;
    const auto afresh = suggestProbes(placed, asked, {});
    ASSERT_TRUE(afresh);
    EXPECT_LT(afresh->before.mean, suggestion->before.mean + 0.01) << "the locked one alone counts";
    EXPECT_TRUE(afresh->moves.empty());
}

TEST_F(SuggestTest, MovesAreDoneOneAfterTheOther) {
    Project project = city->project();
    for (const double along : {10.0, 10.3, 10.6})
        project.probes.push_back({std::to_string(along), onRoad(along), std::nullopt, false});
    SuggestOptions asked = options();
    asked.count = 1;
    asked.baselines = asked.certificate = false;
    const auto suggestion = suggestProbes(with(project), asked, {});
    ASSERT_TRUE(suggestion);
    ASSERT_GE(suggestion->moves.size(), 2U);
    EXPECT_GE(suggestion->moves[0].gain, suggestion->moves[1].gain);
    EXPECT_GT(glm::distance(suggestion->moves[0].to, suggestion->moves[1].to), 4.0)
        << "the first has served that place";
    EXPECT_NE(suggestion->moves[0].id, suggestion->moves[1].id);
}

TEST_F(SuggestTest, RespectsCirclesWithoutProbes) {
    Project project = city->project();
    project.noProbes.push_back({"stop", {690'030.0, 5'335'000.0}, 12.0});
    SuggestOptions asked = options();
    asked.count = 4;
    const auto suggestion = suggestProbes(with(project), asked, {});
    ASSERT_TRUE(suggestion);
    EXPECT_FALSE(suggestion->probes.empty());
    for (const SuggestedProbe& probe : suggestion->probes)
        EXPECT_GT(std::abs(probe.position.x - 690'030.0), 12.0);
    ASSERT_EQ(suggestion->remarks.size(), 1U);
    EXPECT_EQ(suggestion->remarks[0].code, "candidates-forbidden");
}

TEST_F(SuggestTest, WhatCannotBeReachedComesWithTheBestThereIs) {
    SuggestOptions asked = options();
    asked.coverage = 1.0;
    asked.most = 2;
    asked.baselines = false;
    const auto suggestion = suggestProbes(*city, asked, {});
    ASSERT_TRUE(suggestion);
    EXPECT_FALSE(suggestion->reached);
    EXPECT_EQ(suggestion->probes.size(), 2U);
    EXPECT_LT(suggestion->after.mean, 1.0);
    EXPECT_FALSE(suggestion->baselines.uniform);
}

TEST_F(SuggestTest, WorksOnOpenGroundWithoutARoute) {
    Project project = city->project();
    project.routes.clear();
    project.reflectors.clear();
    const PreparedCity bare = with(project);
    SuggestOptions asked = options();
    asked.count = 5;
    asked.spacing = 8.0;
    const auto suggestion = suggestProbes(bare, asked, {});
    ASSERT_TRUE(suggestion) << suggestion.error().message();
    EXPECT_EQ(suggestion->probes.size(), 5U);
    EXPECT_GT(suggestion->after.mean, 0.3);
    const auto report = reportCoverage(bare, {}, {});
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->routes.empty());
    EXPECT_EQ(report->coverage.mean, 0.0);

    CoverageOptions onRoutes;
    onRoutes.on = DemandOn::Routes;
    const auto refused = coveragePlan(bare, onRoutes);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Usage);
}

TEST_F(SuggestTest, TellsWhatIsAskedWrongly) {
    const auto codeOf = [&](const SuggestOptions& asked) {
        const auto suggestion = suggestProbes(*city, asked, {});
        return suggestion ? std::optional<ErrorCode>{} : suggestion.error().code;
    };
    EXPECT_EQ(codeOf({}), ErrorCode::Usage) << "nothing asked for";
    SuggestOptions asked = options();
    asked.coverage = 1.5;
    EXPECT_EQ(codeOf(asked), ErrorCode::Usage);
    asked.coverage = 0.9;
    asked.spacing = 0.0;
    EXPECT_EQ(codeOf(asked), ErrorCode::Usage);
    asked.spacing = 5.0;
    asked.vehicle = "rocket";
    asked.on = DemandOn::Ground;
    EXPECT_EQ(codeOf(asked), ErrorCode::Usage);
    asked.vehicle = "";
    asked.error = 0.0;
    EXPECT_EQ(codeOf(asked), ErrorCode::Usage);
    std::stop_source stop;
    stop.request_stop();
    asked = options();
    asked.count = 2;
    const auto cancelled = suggestProbes(*city, asked, JobContext({}, stop.get_token()));
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);
}

TEST_F(SuggestTest, TheReportTellsWhereItIsWorst) {
    Project project = city->project();
    project.probes.push_back({"west", onRoad(5.0), std::nullopt, false});
    project.probes.push_back({"useless", onRoad(5.0, 0.5), std::nullopt, false});
    const auto report = reportCoverage(with(project), {}, {});
    ASSERT_TRUE(report);
    EXPECT_GT(report->coverage.mean, 0.1);
    EXPECT_LT(report->coverage.mean, 0.9);
    EXPECT_GE(report->seen.mean, report->coverage.mean);
    EXPECT_GE(report->seen.mean, report->seenTwice.mean);
    EXPECT_LE(report->shown.mean, report->coverage.mean + 0.01);
    ASSERT_EQ(report->routes.size(), 1U);
    EXPECT_EQ(report->routes[0].id, "street");
    EXPECT_EQ(report->routes[0].attributes.at("name"), "street");
    ASSERT_FALSE(report->worst.empty());
    EXPECT_GT(report->worst[0].from, 30.0) << "the east end has no probe";
    EXPECT_NEAR(report->worst[0].position.x,
                690'002.0 + 0.5 * (report->worst[0].from + report->worst[0].to), 0.1);
    ASSERT_FALSE(report->objects.empty());
    double all = 0.0;
    for (const ObjectCoverage& object : report->objects) {
        all += object.uncovered;
        EXPECT_LE(object.uncovered, object.reflected);
        EXPECT_EQ(object.type, "Building");
    }
    EXPECT_LE(all, report->uncoveredWalls + 1e-6);
    Project well = city->project();
    for (int k = 0; k < 8; ++k)
        well.probes.push_back({std::to_string(k), onRoad(3.0 + 7.5 * k), std::nullopt, false});
    const auto better = reportCoverage(with(well), {}, {});
    ASSERT_TRUE(better);
    EXPECT_LT(better->uncoveredWalls, 0.5 * report->uncoveredWalls);
    // Walls to the street: 12 houses, 9 m long, 6 to 12 m high, and what shows of their ends.
    EXPECT_GT(report->reflectedWalls, 400.0);
    EXPECT_LT(report->reflectedWalls, 2500.0);
    ASSERT_EQ(report->probes.size(), 2U);
    EXPECT_LT(report->probes[0].loss + report->probes[1].loss, 0.2)
        << "each stands in for the other";
}

TEST_F(SuggestTest, TheWatchFollowsAProbeThatMovesAsIfMeasuredAnew) {
    const auto plan = coveragePlan(*city, {});
    ASSERT_TRUE(plan);
    CoverageWatch watch(city, *plan, 8192, 7);
    EXPECT_EQ(watch.coverage().mean, 0.0);
    std::vector<Probe> probes{{"a", onRoad(10.0), std::nullopt, false},
                              {"b", onRoad(30.0), std::nullopt, false}};
    watch.follow(probes);
    const double before = watch.coverage().mean;
    const glm::dvec3 place = city->inFrame(onRoad(50.0));
    const double gain = watch.gainOf(place, city->project().bake.resolution);
    probes.push_back({"c", onRoad(50.0), std::nullopt, false});
    watch.follow(probes);
    EXPECT_NEAR(watch.coverage().mean, before + gain, 1e-6);
    probes[0].position = onRoad(18.0);
    watch.follow(probes);
    const auto rems = probeSights(*city, probes, {});
    ASSERT_TRUE(rems);
    const SampleCoverage anew =
        coverageOf(watch.demand(), ServiceRule(city->heightfield().grid), *rems);
    EXPECT_EQ(watch.samples().best, anew.best);
    EXPECT_EQ(watch.samples().rem, anew.rem);
    EXPECT_EQ(watch.samples().seenBy, anew.seenBy);
}

}  // namespace
}  // namespace reflet
