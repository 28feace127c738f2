// SPDX-License-Identifier: GPL-3.0-or-later
// What table 1 counts, never its times.
#include "app/pipeline/DrivenCity.h"
#include "app/pipeline/Edit.h"
#include "app/pipeline/Table1.h"
#include "app/pipeline/TracedAnew.h"
#include "core/gpu/EglDisplays.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetProject.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <array>

namespace reflet {
namespace {

using enum Table1Column;

/// A tree beside the road, in front of the third house.
constexpr std::array<double, 3> kTreeLow{22.0, 3.5, 0.0}, kTreeHigh{25.0, 5.5, 6.0};

class Table1 : public testing::Test {
protected:
    void SetUp() override {
        if (eglDisplayCandidates().empty())
            GTEST_SKIP() << "EGL offers no display here.";
        ASSERT_TRUE(test::importStreetWithCar(folder, file,
                                              test::StreetCity().withTree(kTreeLow, kTreeHigh)));
        EditRequest edit;
        edit.probesEvery = 20.0;
        edit.settings = {{"bake.resolution", "32"}, {"tuning.resolution", "32"}};
        ASSERT_TRUE(editProject(file, edit, {}));
        auto opened = openDriven(file, {});
        ASSERT_TRUE(opened) << opened.error().message();
        driven.emplace(std::move(*opened));
    }
    [[nodiscard]] static Table1Options small() {
        Table1Options options;
        options.width = 96;
        options.height = 54;
        options.frames = 3;
        options.cars = {2, 4};
        options.maps = 2;
        return options;
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "street.reflet";
    std::optional<DrivenCity> driven;
};

TEST_F(Table1, CountsTheMapsThatEachColumnMade) {
    const auto report = measureTable1(driven->city, driven->rems.rems, small(), {});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_FALSE(report->renderer.empty());
    EXPECT_EQ(report->resolution, 32);
    EXPECT_EQ(report->probes, driven->rems.rems.size());
    EXPECT_EQ(report->triangles, driven->city.city().triangles.size());
    EXPECT_EQ(report->map.places, 2U);
    for (const double milliseconds :
         {report->map.rerender, report->map.rerenderThinned, report->map.raytrace, report->map.mem})
        EXPECT_GT(milliseconds, 0.0);
    ASSERT_EQ(report->rows.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const Table1Row& row = report->rows[i];
        EXPECT_EQ(row.cars, small().cars[i]);
        EXPECT_GT(row.displayed, 0.0);
        EXPECT_LE(row.displayed, double(row.cars));
        for (const Table1Cell& cell : row.cells) {
            EXPECT_GT(cell.median, 0.0);
            EXPECT_LE(cell.median, cell.worst);
        }
        // A car is one body, with one map: drawn or traced in each picture without levels of
        // detail, and never more often with them.
        EXPECT_EQ(row.at(None).maps, 0.0);
        EXPECT_EQ(row.at(RayTrace).maps, row.displayed);
        EXPECT_EQ(row.at(Rerender).maps, row.at(Mem).maps);
        EXPECT_GT(row.at(Mem).maps, 0.0);
        EXPECT_LE(row.at(Mem).maps, row.displayed);
        EXPECT_LE(row.at(RerenderLod).maps, row.at(Rerender).maps);
        EXPECT_LE(row.at(RayTraceLod).maps, row.at(RayTrace).maps);
        EXPECT_LE(row.at(MemLod).maps, row.at(Mem).maps);
        // Only local maps of probes send rays through the heightfield.
        EXPECT_GT(row.at(Mem).rays, 0.0);
        EXPECT_EQ(row.at(Rerender).rays, 0.0);
        EXPECT_EQ(row.at(None).rays, 0.0);
    }
}

TEST_F(Table1, TracesAMapAnewOnlyWhenItsBodyHasMovedFarEnough) {
    const auto scene = driven->city.scene({});
    ASSERT_TRUE(scene);
    std::vector<BodyInView> bodies{{"car", 0, driven->traffic.at(0, 0.0).mapCenter(0), 1.0, 300.0}};
    TracedAnew always(driven->city, **scene, false), lod(driven->city, **scene, true);
    for (TracedAnew* tracer : {&always, &lod}) {
        const auto maps = tracer->maps(bodies, {});
        ASSERT_TRUE(maps) << maps.error().message();
        ASSERT_EQ(maps->at("car").size(), 1U);
        EXPECT_EQ(tracer->traced(), 1U);
    }
    ASSERT_TRUE(always.maps(bodies, {}) && lod.maps(bodies, {}));
    EXPECT_EQ(always.traced(), 1U);
    EXPECT_EQ(lod.traced(), 0U);
    bodies[0].center.x += 5.0;
    const auto moved = lod.maps(bodies, {});
    ASSERT_TRUE(moved);
    EXPECT_EQ(lod.traced(), 1U);
    EXPECT_EQ(moved->at("car")[0]->center, bodies[0].center);
}

TEST_F(Table1, TellsWhatTreesCost) {
    const auto bare = drivenWithoutTrees(*driven, file, {});
    ASSERT_TRUE(bare) << bare.error().message();
    ASSERT_TRUE(bare->has_value());
    const auto report = measureTable1(driven->city, driven->rems.rems, small(), {}, &**bare);
    ASSERT_TRUE(report) << report.error().message();
    ASSERT_TRUE(report->trees);
    EXPECT_EQ(report->trees->count.objects, 1U);
    EXPECT_EQ(report->trees->count.triangles, 12U);  // a box
    EXPECT_EQ(report->trees->without.places, report->map.places);
    // Ours is not the traced map, with the tree or without.
    ASSERT_TRUE(report->map.psnr && report->trees->without.psnr);
    EXPECT_NE(*report->map.psnr, *report->trees->without.psnr);
    for (const Table1Row& row : report->rows) {
        ASSERT_TRUE(row.trees);
        for (std::size_t i = 0; i < kTable1Columns; ++i) {
            const Table1Cell& without = row.trees->without[i];
            EXPECT_GT(without.median, 0.0);
            // The same cars at the same places.
            if (Table1Column(i) == Mem || Table1Column(i) == RayTrace) {
                EXPECT_EQ(without.maps, row.cells[i].maps);
            }
            // What trees cost lies within what pictures took.
            EXPECT_LE(row.trees->cost[i], row.cells[i].worst);
            EXPECT_GE(row.trees->cost[i], -without.worst);
        }
        // Without a tree the adaptive mesh is another.
        EXPECT_NE(row.trees->without[std::size_t(Mem)].rays, row.at(Mem).rays);
    }
}

TEST_F(Table1, SaysWhatAProjectLacks) {
    const auto report = measureTable1(driven->city, {}, small(), {});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::Usage);
    EXPECT_NE(report.error().remedy.find("sample paper"), std::string::npos);
}

}  // namespace
}  // namespace reflet
