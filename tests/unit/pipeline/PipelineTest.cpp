// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Compare.h"
#include "app/pipeline/Edit.h"
#include "app/pipeline/Import.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetCity.h"
#include "tests/support/StreetProject.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

/// A street with a car, imported into a folder of its own.
class Pipeline : public testing::Test {
protected:
    void SetUp() override {
        const auto imported = test::importStreetWithCar(folder, file);
        ASSERT_TRUE(imported.has_value()) << imported.error().message();
        EditRequest edit;
        edit.probesEvery = 15.0;
        edit.settings = {{"bake.resolution", "32"}, {"tuning.resolution", "32"}};
        const auto edited = editProject(file, edit, {});
        ASSERT_TRUE(edited.has_value()) << edited.error().message();
    }

    [[nodiscard]] PreparedCity prepared() const {
        auto city = PreparedCity::prepare(*loadProject(file), file, {});
        EXPECT_TRUE(city.has_value());
        return std::move(*city);
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "street.reflet";
};

TEST_F(Pipeline, PlacesTheCityInAFrameOfWholeKilometres) {
    const Project project = *loadProject(file);
    EXPECT_EQ(project.frame.crs, "EPSG:25832");
    EXPECT_EQ(project.frame.origin, glm::dvec3(690'000, 5'335'000, 0));
    EXPECT_EQ(project.models[0].path, "street.city.json");
}

TEST_F(Pipeline, DrapesRoutesWithoutHeightsOnTheGround) {
    const Project project = *loadProject(file);
    ASSERT_EQ(project.routes.size(), 1U);
    EXPECT_EQ(project.routes[0].id, "street");
    for (const auto& point : project.routes[0].points)
        EXPECT_NEAR(point.z, 0.0, 1e-6);
}

TEST_F(Pipeline, PlacesProbesAtEqualStepsAlongTheRouteAtBodyHeight) {
    const Project project = *loadProject(file);
    ASSERT_EQ(project.probes.size(), 5U);  // 56 m in steps of at most 15 m
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(project.probes[i].position.x, 690'002.0 + 14.0 * double(i), 1e-6);
        EXPECT_NEAR(project.probes[i].position.z, kProbeHeight, 1e-6);
    }
}

TEST_F(Pipeline, KeysMapsByEverythingThatTheyShow) {
    const PreparedCity city = prepared();
    const BakeSettings settings = city.project().bake;
    const std::string key = city.mapKey({1, 2, 3}, settings);
    EXPECT_EQ(key, prepared().mapKey({1, 2, 3}, settings));
    EXPECT_NE(key, city.mapKey({1, 2, 3.0001}, settings));
    EXPECT_NE(key, city.mapKey({1, 2, 3}, {64, settings.samplesPerEdge}));

    Project evening = city.project();
    evening.date.hour = 19;
    EXPECT_NE(key, PreparedCity::prepare(evening, file, {})->mapKey({1, 2, 3}, settings));
    folder.write("street.city.json", test::StreetCity(7).cityJson());
    EXPECT_NE(key, prepared().mapKey({1, 2, 3}, settings));
}

TEST_F(Pipeline, LightsTheCityAsAtItsOwnPlace) {
    bool known = false;
    Project project = *loadProject(file);
    const Lighting munich = lightingOf(project, {0, 0, 0}, known);
    EXPECT_TRUE(known);
    EXPECT_NEAR(glm::length(munich.sunDirection), 1.0, 1e-9);
    EXPECT_GT(munich.sunDirection.z, 0.5);  // ten in the morning of 15 May
    EXPECT_GT(munich.sunDirection.x, 0.0);  // in the east

    project.frame.crs.reset();
    const Lighting local = lightingOf(project, {0, 0, 0}, known);
    EXPECT_FALSE(known);
    EXPECT_GT(local.sunDirection.z, 0.5);
}

TEST_F(Pipeline, GivesTheSameBitsForAFreshAndAReusedMap) {
    PreparedCity city = prepared();
    const auto fresh = loadRems(city, {});
    const auto reused = loadRems(city, {});
    ASSERT_TRUE(fresh.has_value() && reused.has_value());
    ASSERT_EQ(fresh->rems.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(fresh->rems[i].radiance.texels(), reused->rems[i].radiance.texels());
    }
}

TEST_F(Pipeline, PutsTheStreetCameraInTheOpenAtEyeHeight) {
    const PreparedCity city = prepared();
    const auto traffic = trafficOf(city.project(), city.folder());
    ASSERT_TRUE(traffic.has_value());
    for (double station = 0.0; station <= 56.0; station += 4.0) {
        const PlacedReflector placed = traffic->atStation(0, station);
        const Camera camera = streetCamera(city, placed);
        EXPECT_LT(std::abs(camera.position.y), 6.0) << station;  // between the house fronts
        EXPECT_GT(camera.position.z, 0.5);
        EXPECT_LT(glm::distance(camera.position, placed.middle()), 20.0);
    }
}

TEST_F(Pipeline, FindsNoDifferenceBetweenTheReferenceAndItself) {
    PreparedCity city = prepared();
    CompareOptions options;
    options.poses = 1;
    options.methods = {Method::RayTrace, Method::Nearest};
    options.width = 64;
    options.height = 36;
    options.samplesPerEdge = 1;
    const auto report = compareMethods(city, options, {});
    ASSERT_TRUE(report.has_value()) << report.error().message();
    EXPECT_FALSE(report->methods.at("raytrace").map.psnr.has_value());
    EXPECT_TRUE(report->methods.at("nearest").map.psnr.has_value());
}

TEST_F(Pipeline, WritesNothingWhenAnImportFails) {
    ImportRequest request;
    request.files = {folder / "street.city.json", folder / "absent.city.json"};
    request.output = folder / "new.reflet";
    EXPECT_FALSE(importProject(request, {}).has_value());
    EXPECT_FALSE(std::filesystem::exists(folder / "new.reflet"));
}

TEST_F(Pipeline, CancelsWithoutAResult) {
    std::stop_source stop;
    stop.request_stop();
    PreparedCity city = prepared();
    const auto report = bakeProbes(city, {}, JobContext({}, stop.get_token()));
    ASSERT_FALSE(report.has_value());
    EXPECT_EQ(report.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace reflet
