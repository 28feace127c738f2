// SPDX-License-Identifier: GPL-3.0-or-later
// Where one stands when a project has been opened.
#include "app/document/LiveCity.h"
#include "app/pipeline/Import.h"
#include "app/shell/FirstPicture.h"
#include "core/heightfield/BuiltBounds.h"
#include "core/heightfield/Heightfield.h"
#include "core/project/ProjectFile.h"
#include "tests/ui/window/WindowTestSupport.h"
#include "widgets/viewport/Viewport.h"

#include <QSettings>
#include <QSignalSpy>
#include <cmath>
#include <optional>

namespace reflet::test {
namespace {

constexpr double kNear = 0.05;  // metres

class OpeningViewTest : public WindowTest {
protected:
    void SetUp() override {
        QSettings().remove(QStringLiteral("cameras"));
        ImportRequest request;
        request.files = {city};
        request.routes = folder.write("route.geojson", street.routeGeoJson());
        request.vehicle = "car";
        request.output = file;
        ASSERT_TRUE(importProject(request, {}).has_value());
        Project project = *loadProject(file);
        view.name = "kerb";
        view.position = project.frame.origin + glm::dvec3(12.0, -4.0, 1.7);
        view.target = project.frame.origin + glm::dvec3(30.0, 0.0, 2.0);
        view.verticalFov = 0.8;
        view.time = 1.5;
        project.views = {view};
        ASSERT_TRUE(saveProject(project, file).has_value());
    }
    void leaveOutTheViews() const {
        Project project = *loadProject(file);
        project.views.clear();
        ASSERT_TRUE(saveProject(project, file).has_value());
    }
    static glm::dvec3 eye(MainWindow& window) {
        return window.bench().viewport->camera().position +
               window.document().project().frame.origin;
    }

    std::filesystem::path file = folder / "street.reflet";
    View view;
};

TEST_F(OpeningViewTest, AProjectOpensAtItsFirstViewAtTheViewsTimeAndDrives) {
    MainWindow window;
    open(window, file);
    EXPECT_LT(glm::distance(eye(window), view.position), kNear);
    EXPECT_GE(window.bench().viewport->time(), view.time);
    EXPECT_TRUE(window.bench().viewport->playing());
}

TEST_F(OpeningViewTest, AProjectOpensWhereTheUserLastLookedAtThatFile) {
    const glm::dvec3 moved(20.0, -3.0, 5.0);
    {
        MainWindow window;
        open(window, file);
        window.bench().viewport->setCamera({moved, {40.0, 0.0, 2.0}, 0.7}, false);
        window.close();
    }
    MainWindow again;
    open(again, file);
    EXPECT_LT(glm::distance(again.bench().viewport->camera().position, moved), kNear);
    EXPECT_NEAR(again.bench().viewport->camera().verticalFov, 0.7, 1e-9);
}

TEST_F(OpeningViewTest, WhereOneLookedIsKeptInItsOwnFrameWhenAProjectElsewhereIsOpened) {
    const auto elsewhere = folder / "elsewhere.reflet";
    Project far = *loadProject(file);
    far.frame.origin += glm::dvec3(250.0, -120.0, 3.0);
    ASSERT_TRUE(saveProject(far, elsewhere).has_value());
    MainWindow window;
    open(window, file);
    const glm::dvec3 moved = view.position + glm::dvec3(8.0, 1.0, 4.0);
    const glm::dvec3 origin = window.document().project().frame.origin;
    window.bench().viewport->setCamera({moved - origin, view.target - origin, 0.7}, false);
    open(window, elsewhere);
    open(window, file);
    EXPECT_LT(glm::distance(eye(window), moved), kNear);
}

TEST_F(OpeningViewTest, NothingIsKeptWhenTheUserOnlyWatched) {
    {
        MainWindow window;
        open(window, file);
        window.close();
    }
    EXPECT_TRUE(QSettings().value(QStringLiteral("cameras/order")).toStringList().isEmpty());
}

TEST_F(OpeningViewTest, ADamagedCameraInTheSettingsCountsAsNone) {
    {
        MainWindow window;
        open(window, file);
        window.bench().viewport->setCamera({{20.0, -3.0, 5.0}, {40.0, 0.0, 2.0}, 0.7}, false);
        window.close();
    }
    QSettings settings;
    const QStringList order = settings.value(QStringLiteral("cameras/order")).toStringList();
    ASSERT_EQ(order.size(), 1);
    settings.setValue(QStringLiteral("cameras/") + order.front(),
                      QStringLiteral("1 2 nan 4 5 6 0.7 0"));
    MainWindow again;
    open(again, file);
    EXPECT_LT(glm::distance(eye(again), view.position), kNear);
}

TEST_F(OpeningViewTest, WithoutAViewOneStandsOnThePavementBesideTheVehicle) {
    leaveOutTheViews();
    MainWindow window;
    open(window, file);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
            const auto ground =
                window.bench().live->groundHeight(window.bench().viewport->camera().position.x,
                                                  window.bench().viewport->camera().position.y);
            return std::abs(window.bench().viewport->camera().position.z - ground.value_or(99.0) -
                            1.6) < 0.3;
        },
        kPatience));
}

TEST_F(OpeningViewTest, TheFirstPictureOfACityShowsAllOfItAndNotTheWayThere) {
    Project bare = *loadProject(file);
    bare.views.clear();
    bare.routes.clear();
    bare.reflectors.clear();
    ASSERT_TRUE(saveProject(bare, file).has_value());
    MainWindow window;
    Viewport& viewport = *window.bench().viewport;
    std::optional<Camera> first;
    QObject::connect(&viewport, &Viewport::frameDrawn, &window,
                     [&](const FrameStatistics& statistics) {
                         if (!first && statistics.triangles > 0) {
                             first = viewport.shownCamera();
                         }
                     });
    open(window, file);
    ASSERT_TRUE(QTest::qWaitFor([&] { return first.has_value(); }, kPatience));
    QTest::qWait(500);  // a flight takes 200 ms
    EXPECT_EQ(first->position, viewport.camera().position);
    EXPECT_EQ(first->target, viewport.camera().target);
    const Box built = builtBounds(*window.bench().live->city()->heightfield);
    EXPECT_LT(glm::distance(first->target, built.center()), 0.25 * glm::length(built.size()));
    EXPECT_GT(glm::distance(first->position, built.center()), 0.5 * glm::length(built.size()));
}

TEST_F(OpeningViewTest, CheckingAgainstTheReferenceTurnsTheCameraToTheVehicle) {
    MainWindow window;
    open(window, file);
    Viewport& viewport = *window.bench().viewport;
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return window.bench().live->traffic()->size() == 1; }, kPatience));
    viewport.setPlaying(false);
    viewport.setCamera({{30.0, -4.0, 1.7}, {60.0, -4.0, 1.7}, 0.8}, false);  // the car is behind
    viewport.setFocus();
    QTest::keyClick(&viewport, Qt::Key_C);
    const auto seen = [&] {
        const ViewGeometry now = viewport.geometry();
        const auto car =
            now.project(window.bench().live->traffic()->at(0, viewport.time()).middle());
        return car.depth > 0.0 && car.pixel.x > 0.0 && car.pixel.x < now.width() &&
               car.pixel.y > 0.0 && car.pixel.y < now.height();
    };
    EXPECT_FALSE(viewport.playing());
    EXPECT_TRUE(QTest::qWaitFor(seen, kPatience));
}

TEST_F(OpeningViewTest, CheckingLeavesACameraThatSeesTheVehicleWhereItIs) {
    MainWindow window;
    open(window, file);
    Viewport& viewport = *window.bench().viewport;
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return window.bench().live->traffic()->size() == 1; }, kPatience));
    viewport.setPlaying(false);
    const glm::dvec3 car = window.bench().live->traffic()->at(0, viewport.time()).middle();
    const glm::dvec3 position = car + glm::dvec3(8.0, -4.0, 0.5);
    viewport.setCamera({position, car, 0.8}, false);
    viewport.setFocus();
    QTest::keyClick(&viewport, Qt::Key_C);
    QTest::qWait(500);  // a flight takes 200 ms
    EXPECT_LT(glm::distance(viewport.camera().position, position), kNear);
}

TEST_F(OpeningViewTest, TheFirstPictureIsToldOnce) {
    MainWindow window;
    const FirstPicture first(*window.bench().viewport);
    QSignalSpy shown(&first, &FirstPicture::shown);
    open(window, file);
    ASSERT_TRUE(QTest::qWaitFor([&] { return shown.count() > 0; }, kPatience));
    EXPECT_GT(shown.front().front().toInt(), 0);
    QTest::qWait(300);
    EXPECT_EQ(shown.count(), 1);
}

}  // namespace
}  // namespace reflet::test
