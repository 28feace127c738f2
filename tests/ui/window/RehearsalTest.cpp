// SPDX-License-Identifier: GPL-3.0-or-later
// A planner's work as the program rehearses it: every step comes to its end, a slider's effect is
// on the screen within two pictures, and the planner's own project stays as it was.
#include "app/document/LiveCity.h"
#include "app/shell/PauseWatch.h"
#include "app/shell/rehearsal/Rehearsal.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetProject.h"
#include "tests/ui/window/WindowTestSupport.h"

#include <map>

namespace reflet::test {
namespace {

/// One may be under way when the hand moves and one more be ordered before it: on a busy machine
/// the effect is in the third. Without such a delay it is in the second.
constexpr int kPicturesAtMost = 3;

TEST(RehearsalTest, EveryStepIsDoneAndSlidersAreSeenWithinAFewPictures) {
    const TemporaryFolder folder, copies;
    const auto file = folder / "street.reflet";
    ASSERT_TRUE(importStreetWithCar(folder, file).has_value());
    Project project = *loadProject(file);
    const auto& route = project.routes.front().points;
    Probe probe;
    probe.id = "p-1";
    probe.position = 0.5 * (route.front() + route.back()) + glm::dvec3(0.0, 0.0, 2.0);
    project.probes.push_back(probe);
    ASSERT_TRUE(saveProject(project, file).has_value());
    const std::string before = bytesOf(file);

    MainWindow window;
    StartOptions options;
    options.files << QString::fromStdString(file.string());
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window, kPatience));
    window.start(options);
    PauseWatch watch(1e9, {});
    const auto actions = Rehearsal(window, watch, copies.path()).run();

    std::map<QString, RehearsedAction> named;
    for (const RehearsedAction& action : actions) {
        EXPECT_TRUE(action.done) << action.name.toStdString();
        EXPECT_LE(action.pictures.value_or(0), kPicturesAtMost) << action.name.toStdString();
        named[action.name] = action;
    }
    for (const char* name : {"drive", "drag a probe", "bake its map", "undo", "redo", "save",
                             "add a city", "open another project"}) {
        EXPECT_EQ(named.count(QString::fromLatin1(name)), 1U) << name;
    }
    for (const char* name : {"quality", "detail", "day", "year", "haze", "exposure"}) {
        const auto slider =
            named.find(QStringLiteral("slider “%1Slider”").arg(QLatin1String(name)));
        ASSERT_NE(slider, named.end()) << name;
        EXPECT_GE(slider->second.pictures.value_or(0), 1) << name << " changes no picture";
    }
    EXPECT_EQ(bytesOf(file), before) << "the planner's own project";
    EXPECT_EQ(named.size(), actions.size() - 1) << "it saves twice";
}

}  // namespace
}  // namespace reflet::test
