// SPDX-License-Identifier: GPL-3.0-or-later
// What bench bake counts, never its times.
#include "app/pipeline/Bake.h"
#include "app/pipeline/BakeBench.h"
#include "app/pipeline/Edit.h"
#include "tests/support/StreetProject.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace reflet {
namespace {

TEST(BakeBench, CountsProbesAndThoseThatDependOnAHouse) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "street.reflet";
    ASSERT_TRUE(test::importStreetWithCar(folder, file));
    EditRequest edit;
    edit.probesEvery = 15.0;
    edit.settings = {{"bake.resolution", "32"}};
    ASSERT_TRUE(editProject(file, edit, {}));
    const auto city = PreparedCity::open(file, {});
    ASSERT_TRUE(city);
    BakeBenchOptions options;
    options.resolutions = {32, 64};
    options.probes = 3;
    options.changes = 2;
    const auto report = benchBake(*city, options, {});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_EQ(report->triangles, city->city().triangles.size());
    ASSERT_EQ(report->sizes.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(report->sizes[i].resolution, options.resolutions[i]);
        EXPECT_EQ(report->sizes[i].probes, 3U);
        EXPECT_GT(report->sizes[i].raysPerSecond, 0.0);
        EXPECT_GE(report->sizes[i].milliseconds, report->sizes[i].noting);
    }
    EXPECT_EQ(report->probes, 5U);
    EXPECT_EQ(report->resolution, 32);
    ASSERT_EQ(report->changes.size(), 2U);
    EXPECT_NE(report->changes[0].object, report->changes[1].object);
    for (const BakeBenchChange& change : report->changes) {
        const auto& objects = city->city().objects;
        EXPECT_TRUE(std::any_of(objects.begin(), objects.end(), [&](const CityObject& object) {
            return object.id == change.object && object.type == CityObjectType::Building;
        }));
        EXPECT_EQ(change.baked, 5U) << "a short street: all see each house, or its light";
    }
    // Nothing of it is kept.
    for (const Probe& probe : city->project().probes)
        EXPECT_EQ(cachedRem(*city, probe), nullptr);
}

TEST(BakeBench, SaysWhenThereIsNothingToBake) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "street.reflet";
    ASSERT_TRUE(test::importStreetWithCar(folder, file));
    const auto city = PreparedCity::open(file, {});
    ASSERT_TRUE(city);
    const auto report = benchBake(*city, {}, {});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::Usage);
    EXPECT_NE(report.error().remedy.find("--probes-every"), std::string::npos);
}

}  // namespace
}  // namespace reflet
