// SPDX-License-Identifier: GPL-3.0-or-later
// Every change of a project can be undone and made again without a trace.
#include "app/document/ProjectDocument.h"
#include "tests/unit/document/TestProjects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

namespace reflet {
namespace {

using Kind = ProjectItem::Kind;

std::string jsonOf(const ProjectDocument& document) {
    return projectToJson(document.project());
}

struct Change {
    const char* name;
    std::function<void(ProjectDocument&)> make;
    const char* text;  ///< what the menu says after "Undo"
};

template <class Item>
Item first(const std::vector<Item>& list) {
    return list.front();
}

const std::vector<Change>& allChanges() {
    using D = ProjectDocument;
    static const std::vector<Change> changes{
        {"AddProbe",
         [](D& d) {
             d.addProbe({85'001, 446'002, 3});
         },
         "Add probe-1"},
        {"MoveProbe",
         [](D& d) {
             d.moveProbe("p2", {85'001, 446'002, 3});
         },
         "Move probe p2"},
        {"SetProbe",
         [](D& d) {
             Probe probe = d.project().probes[2];
             probe.resolution = 256;
             d.setProbe(probe);
         },
         "Change resolution of probe p3"},
        {"LockProbe",
         [](D& d) {
             Probe probe = first(d.project().probes);
             probe.locked = true;
             d.setProbe(probe);
         },
         "Lock probe p1"},
        {"AddRoute",
         [](D& d) {
             d.addRoute({{85'000, 446'000, 1}, {85'010, 446'000, 1}});
         },
         "Draw route-1"},
        {"SetRoute",
         [](D& d) {
             RouteSpec route = first(d.project().routes);
             route.points[1].x += 5.0;
             d.setRoute(route);
         },
         "Change route line-1"},
        {"AddReflector", [](D& d) { d.addReflector("tram", "line-2"); }, "Add tram-2"},
        {"SetReflector",
         [](D& d) {
             Reflector reflector = first(d.project().reflectors);
             reflector.speed = 11.0;
             d.setReflector(reflector);
         },
         "Change tram-1"},
        {"MoveReflector",
         [](D& d) {
             Reflector reflector = first(d.project().reflectors);
             reflector.start = 30.0;
             d.setReflector(reflector);
         },
         "Move tram-1"},
        {"AddVehicle",
         [](D& d) {
             VehicleModel vehicle;
             vehicle.path = "models/van.glb";
             d.addVehicle(vehicle);
         },
         "Add vehicle model van"},
        {"SetVehicle",
         [](D& d) {
             VehicleModel vehicle = first(d.project().vehicles);
             vehicle.scale = 0.001;
             d.setVehicle(vehicle);
         },
         "Change vehicle model bike"},
        {"AddView",
         [](D& d) {
             d.setView({"square", "", {1, 2, 3}, {4, 5, 6}, 0.8, 2.0});
         },
         "Add view square"},
        {"SetView",
         [](D& d) {
             d.setView({"corner", "", {1, 2, 3}, {4, 5, 6}, 0.8, 2.0});
         },
         "Change view corner"},
        {"DuplicateProbe",
         [](D& d) {
             static_cast<void>(d.duplicate({{Kind::Probe, "p1"}}));
         },
         "Duplicate probe p1"},
        {"DuplicateSeveral",
         [](D& d) {
             static_cast<void>(d.duplicate({{Kind::Reflector, "tram-1"},
                                            {Kind::Probe, "p1"},
                                            {Kind::Route, "line-1"},
                                            {Kind::View, "corner"},
                                            {Kind::Probe, "p2"}}));
         },
         "Duplicate 5 items"},
        {"RemoveProbes",
         [](D& d) {
             d.remove({{Kind::Probe, "p3"}, {Kind::Probe, "p1"}});
         },
         "Remove 2 probes"},
        {"RemoveRoute",
         [](D& d) {
             d.remove({{Kind::Route, "line-1"}});
         },
         "Remove route line-1"},
        {"RemoveVehicle",
         [](D& d) {
             d.remove({{Kind::Vehicle, "bike"}});
         },
         "Remove vehicle model bike"},
        {"RemoveReflector",
         [](D& d) {
             d.remove({{Kind::Reflector, "car-1"}});
         },
         "Remove car-1"},
        {"RemoveView",
         [](D& d) {
             d.remove({{Kind::View, "corner"}});
         },
         "Remove view corner"},
        {"RemoveModel",
         [](D& d) {
             d.remove({{Kind::Model, "roads/roads.city.json"}});
         },
         "Remove model roads.city.json"},
        {"RemoveEverything",
         [](D& d) {
             std::vector<ProjectItem> items{{Kind::View, "corner"}, {Kind::Vehicle, "bike"}};
             for (const auto& probe : d.project().probes)
                 items.push_back({Kind::Probe, probe.id});
             for (const auto& route : d.project().routes)
                 items.push_back({Kind::Route, route.id});
             for (const auto& model : d.project().models)
                 items.push_back({Kind::Model, model.path});
             d.remove(items);
         },
         "Remove 10 items"},
        {"RenameProbe",
         [](D& d) {
             static_cast<void>(d.rename({Kind::Probe, "p2"}, "bridge"));
         },
         "Rename probe p2 to bridge"},
        {"RenameRoute",
         [](D& d) {
             static_cast<void>(d.rename({Kind::Route, "line-1"}, "L1"));
         },
         "Rename route line-1 to L1"},
        {"RenameReflector",
         [](D& d) {
             static_cast<void>(d.rename({Kind::Reflector, "car-1"}, "taxi"));
         },
         "Rename car-1 to taxi"},
        {"RenameVehicle",
         [](D& d) {
             static_cast<void>(d.rename({Kind::Vehicle, "bike"}, "b"));
         },
         "Rename vehicle model bike to b"},
        {"RenameView",
         [](D& d) {
             static_cast<void>(d.rename({Kind::View, "corner"}, "c"));
         },
         "Rename view corner to c"},
        {"SetName", [](D& d) { d.setName("Rue de la Régence"); }, "Rename the project"},
        {"SetTuning",
         [](D& d) {
             MemSettings tuning;
             tuning.depthRatio = std::numeric_limits<double>::infinity();
             tuning.meshSize = 20;
             d.setTuning(tuning);
         },
         "Tune the reflections"},
        {"SetBake",
         [](D& d) {
             d.setBake({256, 3});
         },
         "Change how probes are baked"},
        {"SetHeightfield",
         [](D& d) {
             d.setHeightfield({0.5, 1'000'000, 64'000'000, {}});
         },
         "Change the heightfield"},
        {"SetDate",
         [](D& d) {
             d.setDate({2026, 6, 21, 18, 30, 0.0, 2.0});
         },
         "Move the sun"},
        {"SetTurbidity", [](D& d) { d.setTurbidity(4.2F); }, "Change the haze"},
        {"SetExposure", [](D& d) { d.setExposure(0.5F); }, "Change the exposure"},
        {"SetGeneratedGround", [](D& d) { d.setGeneratedGround(false); },
         "Take the generated ground away"},
        {"ReplaceProject",
         [](D& d) {
             d.replaceProject(test::largeProject(true), QStringLiteral("Make it reflect"));
         },
         "Make it reflect"},
    };
    return changes;
}

void PrintTo(const Change& change, std::ostream* out) {
    *out << change.name;
}

class EveryChange : public testing::TestWithParam<Change> {};

TEST_P(EveryChange, IsUndoneAndRedoneWithoutATrace) {
    ProjectDocument document;
    document.adopt(test::richProject());
    const std::string before = jsonOf(document);
    GetParam().make(document);
    const std::string after = jsonOf(document);
    EXPECT_NE(after, before);
    EXPECT_TRUE(document.isDirty());
    ASSERT_EQ(document.undoStack()->count(), 1);
    EXPECT_EQ(document.undoStack()->undoText().toStdString(), GetParam().text);
    for (int round = 0; round < 2; ++round) {
        document.undoStack()->undo();
        EXPECT_EQ(jsonOf(document), before);
        EXPECT_FALSE(document.isDirty());
        document.undoStack()->redo();
        EXPECT_EQ(jsonOf(document), after);
    }
}

TEST_P(EveryChange, MakesAProjectThatCanBeReadAgain) {
    ProjectDocument document;
    document.adopt(test::richProject());
    GetParam().make(document);
    const auto read = projectFromJson(jsonOf(document), "after");
    ASSERT_TRUE(read.has_value()) << read.error().message();
    EXPECT_EQ(projectToJson(*read), jsonOf(document));
}

TEST_P(EveryChange, SaysOnceWhatItHasChanged) {
    ProjectDocument document;
    document.adopt(test::richProject());
    int told = 0;
    ProjectChanges what;
    QObject::connect(&document, &ProjectDocument::projectChanged, [&](ProjectChanges flags) {
        ++told;
        what = flags;
    });
    GetParam().make(document);
    EXPECT_EQ(told, 1);
    EXPECT_NE(what, ProjectChanges());
    const ProjectChanges done = what;
    document.undoStack()->undo();
    EXPECT_EQ(told, 2);
    EXPECT_EQ(what, done);
}

INSTANTIATE_TEST_SUITE_P(Changes, EveryChange, testing::ValuesIn(allChanges()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Undo, FollowsARandomWalkOfTwoThousandChangesBackAndForth) {
    constexpr int kSteps = 2'000;
    constexpr int kEvery = 37;  // steps between the looks at the serialisation
    std::mt19937 random(20030704);
    const auto number = [&](int below) {
        return std::uniform_int_distribution<int>(0, below - 1)(random);
    };
    const auto place = [&] {
        return glm::dvec3(85'000 + number(500), 446'000 + number(500), number(20));
    };
    ProjectDocument document;
    document.adopt(test::richProject());
    const Project& project = document.project();
    const auto anyItem = [&]() -> std::optional<ProjectItem> {
        const auto pick = [&](const auto& list, Kind kind, auto id) -> std::optional<ProjectItem> {
            if (list.empty())
                return std::nullopt;
            return ProjectItem{kind, id(list[std::size_t(number(int(list.size())))])};
        };
        switch (number(5)) {
            case 0:
                return pick(project.probes, Kind::Probe, [](auto& p) { return p.id; });
            case 1:
                return pick(project.routes, Kind::Route, [](auto& r) { return r.id; });
            case 2:
                return pick(project.reflectors, Kind::Reflector, [](auto& r) { return r.id; });
            case 3:
                return pick(project.vehicles, Kind::Vehicle, [](auto& v) { return v.id; });
            default:
                return pick(project.views, Kind::View, [](auto& v) { return v.name; });
        }
    };
    const std::vector<std::function<void()>> walk{
        [&] { document.addProbe(place()); },
        [&] { document.addProbe(place()); },
        [&] {
            if (!project.probes.empty()) {
                const std::string id =
                    project.probes[std::size_t(number(int(project.probes.size())))].id;
                const int drag = document.beginDrag();
                for (int i = number(5); i >= 0; --i)
                    document.moveProbe(id, place(), drag);
                document.endDrag();
            }
        },
        [&] {
            document.addRoute({place(), place() + glm::dvec3(1000, 0, 0)});
        },
        [&] {
            if (!project.routes.empty())
                document.addReflector("car", project.routes.back().id);
        },
        [&] {
            VehicleModel vehicle;
            vehicle.path = "van.glb";
            document.addVehicle(vehicle);
        },
        [&] {
            document.setView({"view " + std::to_string(number(9)), "", place(), place(), 1, 0});
        },
        [&] {
            if (const auto item = anyItem())
                document.remove({*item});
        },
        [&] {
            const auto item = anyItem();
            if (item && item->kind != Kind::Vehicle) {
                EXPECT_TRUE(document.duplicate({*item}).has_value());
            }
        },
        [&] {
            if (const auto item = anyItem())
                static_cast<void>(document.rename(*item, "name " + std::to_string(number(50))));
        },
        [&] { document.setExposure(0.1F + 0.1F * float(number(9)), number(2) == 0 ? 7 : -1); },
        [&] {
            document.setBake({32 << number(4), 1 + number(3)});
        },
        [&] {
            Project after = project;
            after.probes.clear();
            after.name += "+";
            if (number(20) == 0)
                document.replaceProject(std::move(after), QStringLiteral("Make it reflect"));
        },
    };

    QUndoStack& stack = *document.undoStack();
    std::map<int, std::string> states{{0, jsonOf(document)}};
    for (int step = 0; step < kSteps; ++step) {
        walk[std::size_t(number(int(walk.size())))]();
        if (step % kEvery == 0 && stack.index() > states.rbegin()->first)
            states[stack.index()] = jsonOf(document);
        else if (stack.index() == states.rbegin()->first)
            states[stack.index()] = jsonOf(document);  // the last step merged, or made none
    }
    states[stack.index()] = jsonOf(document);
    ASSERT_GT(stack.count(), kSteps / 2);
    ASSERT_GT(states.size(), 40U);

    for (auto state = states.rbegin(); state != states.rend(); ++state) {
        while (stack.index() > state->first)
            stack.undo();
        ASSERT_EQ(jsonOf(document), state->second) << "undone to step " << state->first;
    }
    for (const auto& [index, json] : states) {
        while (stack.index() < index)
            stack.redo();
        ASSERT_EQ(jsonOf(document), json) << "redone to step " << index;
    }
}

TEST(SeveralItems, AreOneStepOfADragAndNoneIsChangedWhenOneIsRefused) {
    ProjectDocument document;
    document.adopt(test::richProject());
    const std::string before = jsonOf(document);
    std::vector<Probe> probes = document.project().probes;
    const int drag = document.beginDrag();
    for (int i = 0; i < 3; ++i) {
        for (Probe& probe : probes)
            probe.position.z += 1.0;
        document.setProbes(probes, drag);
    }
    document.endDrag();
    EXPECT_EQ(document.undoStack()->count(), 1);
    EXPECT_EQ(document.project().probes, probes);
    document.undoStack()->undo();
    EXPECT_EQ(jsonOf(document), before);

    int refused = 0;
    QObject::connect(&document, &ProjectDocument::changeRefused, [&] { ++refused; });
    probes[1].position.x = std::numeric_limits<double>::quiet_NaN();
    document.setProbes(probes);
    probes = document.project().probes;
    probes[0].locked = true;
    probes[1].id = "nobody";
    document.setProbes(probes);
    EXPECT_EQ(refused, 2);
    EXPECT_EQ(jsonOf(document), before);
    document.setProbes(document.project().probes);
    EXPECT_FALSE(document.undoStack()->canUndo());
    EXPECT_TRUE(document.undoStack()->canRedo()) << "what changes nothing is no step";
}

TEST(SeveralItems, RoutesAndReflectorsTooAndACancelledDragLeavesNoTrace) {
    ProjectDocument document;
    document.adopt(test::richProject());
    const std::string before = jsonOf(document);
    std::vector<RouteSpec> routes = document.project().routes;
    for (RouteSpec& route : routes)
        route.cornerRadius += 3.0;
    document.setRoutes(routes);
    EXPECT_EQ(document.project().routes, routes);
    std::vector<Reflector> reflectors = document.project().reflectors;
    const int drag = document.beginDrag();
    for (int i = 0; i < 3; ++i) {
        for (Reflector& reflector : reflectors)
            reflector.speed += 1.0;
        document.setReflectors(reflectors, drag);
    }
    EXPECT_EQ(document.project().reflectors, reflectors);
    document.cancelDrag(drag);
    EXPECT_EQ(document.undoStack()->count(), 1);
    document.undoStack()->undo();
    EXPECT_EQ(jsonOf(document), before);
}

}  // namespace
}  // namespace reflet
