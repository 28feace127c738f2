// SPDX-License-Identifier: GPL-3.0-or-later
// What depends on a thing, and the selection, follow it.
#include "app/document/ProjectDocument.h"
#include "tests/unit/document/TestProjects.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace reflet {
namespace {

using Kind = ProjectItem::Kind;
using Items = std::vector<ProjectItem>;

class DependentsTest : public testing::Test {
protected:
    DependentsTest() { document.adopt(test::richProject()); }
    [[nodiscard]] nlohmann::json json() const {
        return nlohmann::json::parse(projectToJson(document.project()));
    }
    ProjectDocument document;
};

TEST_F(DependentsTest, RemovesTheVehiclesOfARouteInTheSameStep) {
    document.remove({{Kind::Route, "line-1"}});
    ASSERT_EQ(document.project().reflectors.size(), 1U);
    EXPECT_EQ(document.project().reflectors[0].id, "car-1");
    EXPECT_EQ(document.undoStack()->count(), 1);
    document.undoStack()->undo();
    EXPECT_EQ(document.project().reflectors, test::richProject().reflectors);
}

TEST_F(DependentsTest, RemovesTheVehiclesOfAVehicleModel) {
    document.remove({{Kind::Vehicle, "bike"}});
    EXPECT_EQ(document.project().reflectors.size(), 2U);
}

TEST_F(DependentsTest, LetsVehiclesFollowARenamedRoute) {
    ASSERT_TRUE(document.rename({Kind::Route, "line-1"}, "ring").has_value());
    EXPECT_EQ(document.project().reflectors[0].route, "ring");
    EXPECT_EQ(document.project().reflectors[1].route, "line-2");
    EXPECT_EQ(document.project().reflectors[2].route, "ring");
    document.undoStack()->undo();
    EXPECT_EQ(document.project().reflectors, test::richProject().reflectors);
}

TEST_F(DependentsTest, LetsVehiclesFollowARenamedVehicleModel) {
    ASSERT_TRUE(document.rename({Kind::Vehicle, "bike"}, "cargo").has_value());
    EXPECT_EQ(document.project().reflectors[2].vehicle, "cargo");
    EXPECT_EQ(document.project().reflectors[0].vehicle, "tram");
}

TEST_F(DependentsTest, RefusesNamesThatAreEmptyOrTaken) {
    for (const ProjectItem& item :
         {ProjectItem{Kind::Probe, "p1"}, ProjectItem{Kind::Route, "line-1"}}) {
        const auto blank = document.rename(item, "  ");
        ASSERT_FALSE(blank.has_value());
        EXPECT_EQ(blank.error().code, ErrorCode::Usage);
    }
    EXPECT_FALSE(document.rename({Kind::Probe, "p1"}, "p2").has_value());
    EXPECT_FALSE(document.rename({Kind::Vehicle, "bike"}, "tram").has_value());
    EXPECT_FALSE(document.rename({Kind::Probe, "absent"}, "x").has_value());
    EXPECT_FALSE(document.rename({Kind::Model, "city.city.json"}, "x").has_value());
    EXPECT_TRUE(document.rename({Kind::Probe, "p1"}, "line-1").has_value()) << "another kind";
    EXPECT_EQ(document.undoStack()->count(), 1);
}

TEST_F(DependentsTest, KeepsTheUnknownKeysOfARenamedProbe) {
    EXPECT_EQ(json()["probes"][1]["note"], "on the bridge");
    ASSERT_TRUE(document.rename({Kind::Probe, "p2"}, "bridge").has_value());
    EXPECT_EQ(json()["probes"][1]["id"], "bridge");
    EXPECT_EQ(json()["probes"][1]["note"], "on the bridge");
    EXPECT_EQ(json()["note"], "by hand");
}

TEST_F(DependentsTest, GivesARenamedProbeNoKeysOfOneThatWasRemoved) {
    document.remove({{Kind::Probe, "p2"}});
    ASSERT_TRUE(document.rename({Kind::Probe, "p1"}, "p2").has_value());
    EXPECT_FALSE(json()["probes"][0].contains("note"));
    document.undoStack()->undo();
    document.undoStack()->undo();
    EXPECT_EQ(json()["probes"][1]["note"], "on the bridge");
}

TEST_F(DependentsTest, SelectsWhatWasAddedDuplicatedOrBroughtBack) {
    const Selection& selection = *document.selection();
    const std::string id = document.addProbe({1, 1, 1});
    EXPECT_EQ(selection.items(), (Items{{Kind::Probe, id}}));
    const auto copies = document.duplicate({{Kind::Route, "line-2"}});
    ASSERT_TRUE(copies.has_value());
    EXPECT_EQ(selection.items(), (Items{{Kind::Route, copies->front()}}));
    document.remove({{Kind::Route, "line-1"}});
    document.undoStack()->undo();
    EXPECT_TRUE(selection.contains({Kind::Route, "line-1"}));
    EXPECT_TRUE(selection.contains({Kind::Reflector, "tram-1"}));
}

TEST_F(DependentsTest, DropsWhatIsGoneFromTheSelection) {
    document.selection()->set(Items{{Kind::Probe, "p1"}, {Kind::Reflector, "tram-1"}});
    int told = 0;
    QObject::connect(document.selection(), &Selection::changed, [&] { ++told; });
    document.remove({{Kind::Route, "line-1"}});
    EXPECT_EQ(document.selection()->items(), (Items{{Kind::Probe, "p1"}}));
    EXPECT_EQ(told, 1);
    document.moveProbe("p1", {1, 1, 1});
    EXPECT_EQ(told, 1);
}

TEST_F(DependentsTest, KeepsARenamedItemSelected) {
    document.selection()->set(Items{{Kind::Probe, "p1"}, {Kind::Route, "line-1"}});
    ASSERT_TRUE(document.rename({Kind::Route, "line-1"}, "ring").has_value());
    EXPECT_EQ(document.selection()->items(), (Items{{Kind::Probe, "p1"}, {Kind::Route, "ring"}}));
    document.undoStack()->undo();
    EXPECT_EQ(document.selection()->items(), (Items{{Kind::Probe, "p1"}, {Kind::Route, "line-1"}}));
}

TEST_F(DependentsTest, TellsOfChangesWhenTheSelectionIsRightAlready) {
    document.selection()->set(ProjectItem{Kind::Probe, "p1"});
    std::size_t selected = 99;
    QObject::connect(&document, &ProjectDocument::projectChanged,
                     [&] { selected = document.selection()->items().size(); });
    document.remove({{Kind::Probe, "p1"}});
    EXPECT_EQ(selected, 0U);
}

TEST(Selection, HoldsEachItemOnceAndTellsOnlyOfChanges) {
    Selection selection;
    int told = 0;
    QObject::connect(&selection, &Selection::changed, [&] { ++told; });
    selection.set(Items{{Kind::Probe, "a"}, {Kind::Probe, "b"}, {Kind::Probe, "a"}});
    EXPECT_EQ(selection.items().size(), 2U);
    selection.add({Kind::Probe, "b"});
    EXPECT_EQ(told, 1);
    selection.toggle({Kind::Probe, "a"});
    EXPECT_EQ(selection.ids(Kind::Probe), std::vector<std::string>{"b"});
    selection.toggle({Kind::Route, "a"});
    EXPECT_EQ(selection.current(), (ProjectItem{Kind::Route, "a"}));
    selection.clear();
    EXPECT_FALSE(selection.current().has_value());
    EXPECT_EQ(told, 4);
}

}  // namespace
}  // namespace reflet
