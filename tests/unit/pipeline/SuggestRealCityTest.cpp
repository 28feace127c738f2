// SPDX-License-Identifier: GPL-3.0-or-later
// Suggestions along a street of a real city, and on the ground of one without any.
#include "app/pipeline/Import.h"
#include "app/pipeline/coverage/CoverageReport.h"
#include "app/pipeline/coverage/Suggest.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

TEST(SuggestRealCity, AStreetOfDelftIsCoveredWithNineTenthsOfTheBestThereCanBe) {
    const auto file = test::sharedData("cityjson/delft-campus.city.json");
    if (!file)
        GTEST_SKIP() << test::kNoSharedData;
    const test::TemporaryFolder folder;
    ImportRequest request;
    request.files = {*file};
    request.output = folder.path() / "delft.reflet";
    request.vehicle = "bus";
    request.routes = folder.write("route.geojson", R"({"type":"FeatureCollection",
        "crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::28992"}},
        "features":[{"type":"Feature","properties":{"name":"street","surface":"asphalt"},
        "geometry":{"type":"LineString","coordinates":[[85554.25,446961.75],[85526.25,446779.75]]}}]})");
    ASSERT_TRUE(importProject(request, {}));
    const auto city = PreparedCity::open(request.output, {});
    ASSERT_TRUE(city);
    SuggestOptions options;
    options.coverage = 0.9;
    const auto suggestion = suggestProbes(*city, options, {});
    ASSERT_TRUE(suggestion) << suggestion.error().message();
    EXPECT_TRUE(suggestion->reached);
    EXPECT_GE(suggestion->after.mean, 0.9 - suggestion->after.error);
    EXPECT_LE(suggestion->after.error, 0.005);
    EXPECT_GE(suggestion->ratio(), 0.9);
    EXPECT_GE(suggestion->probes.size(), suggestion->fewest);
    // An even spacing along one straight street is nearly as good; worse it must not be.
    ASSERT_TRUE(suggestion->baselines.uniformCount);
    EXPECT_LE(suggestion->probes.size(), *suggestion->baselines.uniformCount);
    ASSERT_TRUE(suggestion->baselines.random);
    EXPECT_GT(suggestion->optimised, *suggestion->baselines.random);

    const auto accepted =
        city->updated(withSuggested(city->project(), *suggestion), request.output, {});
    ASSERT_TRUE(accepted);
    const auto report = reportCoverage(*accepted, {}, {});
    ASSERT_TRUE(report);
    EXPECT_NEAR(report->coverage.mean, suggestion->after.mean, 0.012);
    EXPECT_EQ(report->routes.at(0).attributes.at("surface"), "asphalt");
    EXPECT_GT(report->reflectedWalls, 500.0);
    EXPECT_LT(report->uncoveredWalls, 0.2 * report->reflectedWalls);
}

TEST(SuggestRealCity, ACityOfBuildingsAloneHasGroundToDriveOn) {
    const auto file = test::sharedData("cityjson/zurich.city.json");
    if (!file)
        GTEST_SKIP() << test::kNoSharedData;
    const test::TemporaryFolder folder;
    ImportRequest request;
    request.files = {*file};
    request.output = folder.path() / "zurich.reflet";
    ASSERT_TRUE(importProject(request, {}));
    const auto city = PreparedCity::open(request.output, {});
    ASSERT_TRUE(city);
    const auto plan = coveragePlan(*city, {});
    ASSERT_TRUE(plan) << plan.error().message();
    ASSERT_TRUE(plan->ground);
    EXPECT_GT(plan->ground->places.size(), 1000U);
    EXPECT_LE(plan->ground->places.size(), 300'000U);
    SuggestOptions options;
    options.count = 4;
    options.spacing = 60.0;
    options.certificate = options.baselines = false;
    options.mostSamples = 16'384;
    const auto suggestion = suggestProbes(*city, options, {});
    ASSERT_TRUE(suggestion) << suggestion.error().message();
    EXPECT_EQ(suggestion->probes.size(), 4U);
}

}  // namespace
}  // namespace reflet
