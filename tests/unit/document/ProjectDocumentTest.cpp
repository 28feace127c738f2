// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/ProjectDocument.h"
#include "tests/unit/document/TestProjects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace reflet {
namespace {

using Kind = ProjectItem::Kind;

/// A document with the rich project, and what it refuses.
class ProjectDocumentTest : public testing::Test {
protected:
    ProjectDocumentTest() {
        document.adopt(test::richProject());
        QObject::connect(&document, &ProjectDocument::changeRefused,
                         [this](const Error& error) { refused.push_back(error); });
    }
    [[nodiscard]] int steps() { return document.undoStack()->count(); }

    ProjectDocument document;
    std::vector<Error> refused;
};

TEST_F(ProjectDocumentTest, MergesTheMovesOfOneDragIntoOneStep) {
    const glm::dvec3 before = document.project().probes[0].position;
    const int drag = document.beginDrag();
    for (int i = 1; i <= 10; ++i)
        document.moveProbe("p1", before + glm::dvec3(i, 0, 0), drag);
    document.endDrag();
    EXPECT_EQ(steps(), 1);
    EXPECT_EQ(document.project().probes[0].position, before + glm::dvec3(10, 0, 0));
    document.undoStack()->undo();
    EXPECT_EQ(document.project().probes[0].position, before);
}

TEST_F(ProjectDocumentTest, KeepsDragsOfDifferentThingsAndDifferentDragsApart) {
    const int drag = document.beginDrag();
    document.moveProbe("p1", {1, 1, 1}, drag);
    document.moveProbe("p2", {2, 2, 2}, drag);
    const int next = document.beginDrag();
    EXPECT_NE(next, drag);
    document.moveProbe("p2", {3, 3, 3}, next);
    document.setExposure(2.0F, next);
    document.setTurbidity(3.0F, next);
    EXPECT_EQ(steps(), 5);
}

TEST_F(ProjectDocumentTest, MakesAStepOfEachChangeOutsideADrag) {
    document.moveProbe("p1", {1, 1, 1});
    document.moveProbe("p1", {2, 2, 2});
    EXPECT_EQ(steps(), 2);
}

TEST_F(ProjectDocumentTest, ForgetsADragThatEndsWhereItBegan) {
    const glm::dvec3 before = document.project().probes[0].position;
    const int drag = document.beginDrag();
    document.moveProbe("p1", {1, 1, 1}, drag);
    document.moveProbe("p1", before, drag);
    EXPECT_EQ(steps(), 0);
    EXPECT_FALSE(document.isDirty());
}

TEST_F(ProjectDocumentTest, TakesACancelledDragBackWithoutAStepToRedo) {
    const std::string before = projectToJson(document.project());
    const int drag = document.beginDrag();
    document.moveProbe("p1", {1, 1, 1}, drag);
    document.moveProbe("p1", {2, 2, 2}, drag);
    document.cancelDrag(drag);
    EXPECT_EQ(projectToJson(document.project()), before);
    EXPECT_EQ(steps(), 0);
    EXPECT_FALSE(document.isDragging());
    document.addProbe({5, 5, 5});
    document.cancelDrag(drag);
    EXPECT_EQ(steps(), 1) << "a step of something else is no part of the drag";
}

TEST_F(ProjectDocumentTest, DoesNotMergeIntoAStepThatWasSaved) {
    document.setExposure(2.0F, 3);
    document.undoStack()->setClean();
    document.setExposure(3.0F, 3);
    EXPECT_TRUE(document.isDirty());
    EXPECT_EQ(steps(), 2);
}

TEST_F(ProjectDocumentTest, MakesNoStepOfAChangeThatChangesNothing) {
    document.moveProbe("p1", document.project().probes[0].position);
    document.setExposure(document.project().exposure);
    document.setRoute(document.project().routes[0]);
    document.setView(document.project().views[0]);
    document.replaceProject(document.project(), QStringLiteral("nothing"));
    document.remove({{Kind::Probe, "absent"}});
    EXPECT_TRUE(document.rename({Kind::Probe, "p1"}, "p1").has_value());
    EXPECT_EQ(steps(), 0);
}

TEST_F(ProjectDocumentTest, GivesReadableIdsThatNothingHas) {
    EXPECT_EQ(document.addProbe({1, 1, 1}), "probe-1");
    EXPECT_EQ(document.addProbe({2, 2, 2}), "probe-2");
    document.remove({{Kind::Probe, "probe-1"}});
    EXPECT_EQ(document.addProbe({3, 3, 3}), "probe-1");
    EXPECT_EQ(document.addRoute({{0, 0, 0}, {10, 0, 0}}), "route-1");
    EXPECT_EQ(document.addReflector("tram", "route-1"), "tram-2");
    EXPECT_EQ(document.addReflector("bike", "route-1"), "bike-2");
    VehicleModel tram;
    tram.path = "my/tram.glb";
    EXPECT_EQ(document.addVehicle(tram), "tram-1") << "tram is a built-in vehicle";
    tram.path = "my/bike.glb";
    EXPECT_EQ(document.addVehicle(tram), "bike-1");
    EXPECT_EQ(*document.duplicate({{Kind::Probe, "probe-2"}, {Kind::Probe, "p1"}}),
              (std::vector<std::string>{"probe-3", "p5"}));
}

TEST_F(ProjectDocumentTest, NumbersCopiesLikeWhatTheyWereCopiedFrom) {
    document.setView({"view 9", "", {1, 1, 1}, {2, 2, 2}, 1, 0});
    const std::vector<std::pair<ProjectItem, std::string>> expected{
        {{Kind::View, "corner"}, "corner 2"},
        {{Kind::View, "corner 2"}, "corner 3"},
        {{Kind::View, "view 9"}, "view 10"},
        {{Kind::Route, "line-1"}, "line-3"},
        {{Kind::Reflector, "tram-1"}, "tram-2"}};
    for (const auto& [item, name] : expected)
        EXPECT_EQ(*document.duplicate({item}), std::vector<std::string>{name});
    ASSERT_TRUE(document.rename({Kind::Probe, "p1"}, "p009").has_value());
    EXPECT_EQ(*document.duplicate({{Kind::Probe, "p009"}}), std::vector<std::string>{"p010"});
}

TEST_F(ProjectDocumentTest, RefusesGeometryThatCouldNotBeReadAgain) {
    const double nan = std::nan("");
    EXPECT_EQ(document.addProbe({nan, 0, 0}), "");
    EXPECT_EQ(document.addProbe({1e12, 0, 0}), "");
    document.moveProbe("p1", {0, std::numeric_limits<double>::infinity(), 0});
    EXPECT_EQ(document.addRoute({}), "");
    EXPECT_EQ(document.addRoute({{1, 1, 1}, {1, 1, 5}}), "");
    RouteSpec route = document.project().routes[0];
    route.cornerRadius = -1.0;
    document.setRoute(route);
    document.setView({"", "", {1, 1, 1}, {2, 2, 2}, 1, 0});
    document.setDate({2026, 2, 30, 10, 0, 0.0, 2.0});
    EXPECT_EQ(refused.size(), 8U);
    EXPECT_EQ(steps(), 0);
    for (const Error& error : refused)
        EXPECT_FALSE(error.remedy.empty()) << error.what;
}

TEST_F(ProjectDocumentTest, RefusesChangesOfWhatIsNotThere) {
    document.moveProbe("absent", {1, 1, 1});
    EXPECT_EQ(document.addReflector("tram", "absent"), "");
    Reflector reflector = document.project().reflectors[0];
    reflector.route = "absent";
    document.setReflector(reflector);
    EXPECT_EQ(refused.size(), 3U);
    EXPECT_FALSE(document.duplicate({{Kind::Probe, "absent"}}).has_value());
    EXPECT_FALSE(document.duplicate({{Kind::Model, "city.city.json"}}).has_value());
    EXPECT_EQ(steps(), 0);
}

TEST_F(ProjectDocumentTest, BringsSettingsIntoTheRangeThatAProjectCanHold) {
    MemSettings tuning;
    tuning.meshSize = 0;
    tuning.resolution = 1'000'000;
    tuning.smallestQuad = -1.0;
    tuning.depthRatio = std::nan("");
    document.setTuning(tuning);
    document.setBake({0, 99});
    document.setHeightfield({-3.0, 0, 1, {}});
    document.setTurbidity(0.0F);
    document.setExposure(-1.0F);
    Reflector reflector = document.project().reflectors[0];
    reflector.speed = 1e9;
    reflector.start = -5.0;
    document.setReflector(reflector);
    document.setView({"wide", "", {1, 1, 1}, {2, 2, 2}, 99.0, -1.0});
    VehicleModel vehicle = document.project().vehicles[0];
    vehicle.scale = 0.0;
    vehicle.heading = 1e6;
    document.setVehicle(vehicle);
    const auto read = projectFromJson(projectToJson(document.project()), "after");
    EXPECT_TRUE(read.has_value()) << read.error().message();
    EXPECT_EQ(document.project().tuning.depthRatio, MemSettings{}.depthRatio);
    EXPECT_EQ(document.project().tuning.meshSize, 1);
    EXPECT_EQ(document.project().bake, (BakeSettings{32, 16}));
}

TEST_F(ProjectDocumentTest, NamesOnlyWhatAStepHasChanged) {
    ProjectChanges what;
    QObject::connect(&document, &ProjectDocument::projectChanged,
                     [&](ProjectChanges flags) { what = flags; });
    const auto after = [&](auto change) {
        what = {};
        change();
        return what;
    };
    EXPECT_EQ(after([&] { document.addProbe({1, 1, 1}); }), ProjectChange::Probes);
    EXPECT_EQ(after([&] { document.setTuning({20}); }), ProjectChange::Tuning);
    EXPECT_EQ(after([&] { document.setTurbidity(5.0F); }), ProjectChange::Light);
    EXPECT_EQ(after([&] {
                  document.remove({{Kind::Route, "line-2"}});
              }),
              ProjectChange::Routes | ProjectChange::Reflectors);
    EXPECT_EQ(after([&] {
                  Project project = document.project();
                  project.exposure = 3.0F;
                  project.views.clear();
                  document.replaceProject(std::move(project), QStringLiteral("x"));
              }),
              ProjectChange::Exposure | ProjectChange::Views);
    EXPECT_EQ(after([&] { document.close(); }), ProjectChanges(ProjectChange::All));
}

}  // namespace
}  // namespace reflet
