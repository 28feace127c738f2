// SPDX-License-Identifier: GPL-3.0-or-later
// Which probes are baked again when the city changes.
#include "app/pipeline/Bake.h"
#include "app/pipeline/Edit.h"
#include "app/pipeline/Import.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetCity.h"
#include "tests/support/StreetProject.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

/// The street with a wall behind its northern houses, which closes the gaps between them.
test::StreetCity street() {
    return test::StreetCity().withHouse({-39, 17, 0}, {99, 19, 9});
}
/// A house far behind that wall.
test::StreetCity withHidden(double height) {
    return street().withHouse({20, 200, 0}, {28, 210, height});
}

/// That street with five probes, off all round numbers, baked.
class KeptProbes : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(test::importStreetWithCar(folder, file));
        deliver(street());
        EditRequest edit;
        edit.probesEvery = 15.0;
        edit.settings = {{"bake.resolution", "32"}};
        ASSERT_TRUE(editProject(file, edit, {}));
        Project project = *loadProject(file);
        for (Probe& probe : project.probes)
            probe.position += glm::dvec3(0.137, 0.291, 0.013);
        ASSERT_TRUE(saveProject(project, file));
        EXPECT_EQ(bake().baked, 5U);
    }

    [[nodiscard]] PreparedCity city(const std::filesystem::path& path) const {
        auto prepared = PreparedCity::open(path, {});
        EXPECT_TRUE(prepared.has_value());
        return std::move(*prepared);
    }
    [[nodiscard]] BakeReport bake() const {
        const auto report = bakeProbes(city(file), {}, {});
        EXPECT_TRUE(report.has_value());
        return report.value_or(BakeReport{});
    }
    /// Baked in a folder without any cache.
    [[nodiscard]] std::vector<RemSet::Pointer> fresh() const {
        const test::TemporaryFolder elsewhere;
        for (const char* name : {"street.city.json", "street.reflet"})
            std::filesystem::copy_file(folder / name, elsewhere / name);
        const PreparedCity prepared = city(elsewhere / "street.reflet");
        std::vector<RemSet::Pointer> maps;
        for (const Probe& probe : prepared.project().probes)
            maps.push_back(bakeProbe(prepared, probe, {}).value_or(nullptr));
        return maps;
    }
    void deliver(test::StreetCity street) const {
        folder.write("street.city.json", street.cityJson());
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "street.reflet";
};

TEST_F(KeptProbes, AHouseThatNobodySeesLeavesThemAsTheyAre) {
    deliver(withHidden(3));
    const BakeReport report = bake();
    EXPECT_EQ(report.kept, 5U);
    EXPECT_EQ(report.baked, 0U);
    EXPECT_EQ(report.reused, 0U);
    EXPECT_GT(report.bytes, 0U);
    const PreparedCity now = city(file);
    const auto maps = fresh();
    ASSERT_EQ(maps.size(), 5U);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const auto kept = cachedRem(now, now.project().probes[i]);
        ASSERT_TRUE(kept && maps[i]);
        EXPECT_EQ(kept->radiance.texels(), maps[i]->radiance.texels());
        EXPECT_EQ(kept->distance.texels(), maps[i]->distance.texels());
    }
    EXPECT_EQ(bake().reused, 5U);
    // What was kept once is kept again, and is still known to see the street.
    deliver(withHidden(4));
    EXPECT_EQ(bake().kept, 5U);
    deliver(street().withBridge());
    EXPECT_EQ(bake().baked, 5U);
}

TEST_F(KeptProbes, WhatStandsInTheStreetIsBakedByAllThatSeeIt) {
    deliver(street().withBridge());
    EXPECT_EQ(bake().baked, 5U);
    // Back again: the maps of then are still there.
    deliver(street());
    EXPECT_EQ(bake().reused, 5U);
}

TEST_F(KeptProbes, AProbeThatIsBuiltOverIsRefused) {
    deliver(street().withHouse({14, -2, 0}, {18, 3, 5}));
    const BakeReport report = bake();
    ASSERT_EQ(report.failures.size(), 1U);
    EXPECT_EQ(report.kept, 0U);
    EXPECT_EQ(report.baked, 4U);
}

TEST_F(KeptProbes, WithoutTheirSightsTheyAreBakedAgain) {
    std::filesystem::remove_all(cacheFolder(file) / "sight");
    deliver(withHidden(3));
    EXPECT_EQ(bake().baked, 5U);
}

TEST_F(KeptProbes, AnotherLightIsNothingToBeKept) {
    Project project = *loadProject(file);
    project.date.hour += 1;
    ASSERT_TRUE(saveProject(project, file));
    EXPECT_EQ(bake().baked, 5U);
}

}  // namespace
}  // namespace reflet
