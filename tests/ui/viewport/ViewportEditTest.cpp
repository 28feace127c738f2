// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/viewport/ViewportWindow.h"

#include <QLabel>
#include <QSignalSpy>
#include <cmath>

namespace reflet {
namespace {

using test::eventually;

class ViewportEdit : public test::ViewportWindow {
protected:
    ViewportEdit() {
        QObject::connect(&view->intents(), &EditIntents::probeDragged, view.get(),
                         [this](const QString& id, const glm::dvec3& place, DragPhase phase) {
                             dragged.emplace_back(id, place, phase);
                         });
        QObject::connect(
            &view->intents(), &EditIntents::routePointDragged, view.get(),
            [this](const QString& id, int index, const glm::dvec3& place, DragPhase phase) {
                dragged.emplace_back(id + QString::number(index), place, phase);
            });
        QObject::connect(
            &view->intents(), &EditIntents::routePointInserted, view.get(),
            [this](const QString& id, int index, const glm::dvec3& place, DragPhase phase) {
                dragged.emplace_back(id + "+" + QString::number(index), place, phase);
            });
        QObject::connect(&view->intents(), &EditIntents::probePlaced, view.get(),
                         [this](const glm::dvec3& place) { placed.push_back(place); });
        QObject::connect(&view->intents(), &EditIntents::routeDrawn, view.get(),
                         [this](const std::vector<glm::dvec3>& points) { drawn = points; });
        QObject::connect(&view->intents(), &EditIntents::clicked, view.get(),
                         [this](const std::optional<ProjectItem>& item, bool) { clicked = item; });
        QObject::connect(&view->intents(), &EditIntents::reflectorDragged, view.get(),
                         [this](const QString&, double station, DragPhase phase) {
                             stations.emplace_back(station, phase);
                         });
    }
    void showRoute(bool selected) {
        RouteGlyph route{.id = "r", .line = {{-30, -5, 0}, {0, -5, 0}, {25, 0, 0}}, .handles = {}};
        route.handles = route.line;
        route.selected = selected;
        view->setRoutes({route});
    }
    void showCar() {
        auto vehicle = std::make_shared<Vehicle>();
        VehicleMaterial paint;
        paint.clearCoat = 1.0F;
        paint.metallic = 1.0F;  // a mirror: what it shows is what it reflects
        vehicle->materials = {paint};
        VehicleBody body;
        body.vertices = {{-2.2F, -0.9F, 0.0F}, {2.2F, -0.9F, 0.0F}, {0.0F, 0.9F, 1.5F}};
        body.normals = {{0, -1, 0}, {0, -1, 0}, {0, -1, 0}};
        body.triangles = {{0, 1, 2}};
        body.triangleMaterial = {0};
        body.pivotSpan = 2.6;
        body.center = {0, 0, 0.8F};
        vehicle->bodies = {body};
        auto traffic = std::make_shared<Traffic>();
        Drive drive;
        drive.id = "car";
        drive.routeId = "r";
        drive.vehicle = vehicle;
        drive.route = std::make_shared<const Route>(Route({{-30, -5, 0}, {30, -5, 0}}));
        drive.speed = 8.0;
        drive.start = 20.0;
        traffic->add(drive);
        view->setTraffic(traffic);
    }

    std::vector<std::tuple<QString, glm::dvec3, DragPhase>> dragged;
    std::vector<glm::dvec3> placed;
    std::vector<glm::dvec3> drawn;
    std::vector<std::pair<double, DragPhase>> stations;
    std::optional<ProjectItem> clicked;
};

TEST_F(ViewportEdit, BeforeTheFirstProbesPictureAVehicleReflectsTheSkyAndTheCaptionSaysSo) {
    showCar();
    view->setCamera({{-10, -12, 3}, {-10, -5, 0.6}, 0.9}, false);
    const auto* caption = view->findChild<QLabel*>(QStringLiteral("viewportCaption"));
    ASSERT_NE(caption, nullptr);
    const auto saysSo = [&] {
        return caption->text().contains(QStringLiteral("no probe picture"));
    };
    const auto lightOfCar = [&] {
        const QImage picture = view->grabPicture();
        const QPoint middle = pixelOf({-10, -5, 0.6}) * picture.width() / view->width();
        return picture.rect().contains(middle) ? qGray(picture.pixel(middle)) : -1;
    };
    view->setMethods(Method::Sky, std::nullopt);
    ASSERT_TRUE(eventually([&] { return lightOfCar() > 60; })) << lightOfCar();
    const int underTheSky = lightOfCar();
    EXPECT_FALSE(saysSo()) << "the sky alone was asked for";

    view->setMethods(Method::Mem, std::nullopt);
    EXPECT_TRUE(eventually(saysSo));
    EXPECT_TRUE(eventually([&] { return std::abs(lightOfCar() - underTheSky) <= 2; }));

    ReferenceEnvironmentMap black;
    black.id = "black";
    black.center = {-10, -8, 1};
    black.radiance = CubeMap<glm::vec3>(8);
    black.distance = CubeMap<float>(8, 10.0F);
    view->setRems(RemSet{black});
    EXPECT_TRUE(eventually([&] { return !saysSo(); }));
    EXPECT_TRUE(eventually([&] { return lightOfCar() < underTheSky - 20; }))
        << "what a probe has seen counts, be it black";
}

TEST_F(ViewportEdit, SelectsAProbeByAClickAndNothingByAClickBeside) {
    view->setProbes({{.id = "p", .position = {-8, 4, 1.75}}});
    click(pixelOf({-8, 4, 1.75}));
    ASSERT_TRUE(clicked);
    EXPECT_EQ(*clicked, (ProjectItem{ProjectItem::Kind::Probe, "p"}));
    click({900, 650});
    EXPECT_FALSE(clicked);
}

TEST_F(ViewportEdit, DragsAProbeInItsLevelPlane) {
    const glm::dvec3 start{-8, 4, 1.75};
    view->setProbes({{.id = "p", .position = start}});
    const QPoint from = pixelOf(start), to = from + QPoint(90, 40);
    const glm::dvec2 offset =
        glm::dvec2(from.x(), from.y()) - view->geometry().project(start).pixel;
    dragFromTo(from, to);
    ASSERT_GE(dragged.size(), 3U);
    EXPECT_EQ(std::get<2>(dragged.front()), DragPhase::Begin);
    EXPECT_EQ(std::get<2>(dragged.back()), DragPhase::End);
    const Ray ray = view->geometry().ray(glm::dvec2(to.x(), to.y()) - offset);
    const glm::dvec3 wanted = ray.at((1.75 - ray.origin.z) / ray.direction.z);
    EXPECT_LT(glm::distance(std::get<1>(dragged.back()), wanted), 0.01);
    EXPECT_EQ(view->camera().position, kStart.position);
}

TEST_F(ViewportEdit, LiftsAProbeWithShift) {
    const glm::dvec3 start{-8, 4, 1.75};
    view->setProbes({{.id = "p", .position = start}});
    dragFromTo(pixelOf(start), pixelOf(start) - QPoint(0, 50), Qt::LeftButton, Qt::ShiftModifier);
    ASSERT_FALSE(dragged.empty());
    const glm::dvec3 end = std::get<1>(dragged.back());
    EXPECT_EQ(end.x, start.x);
    EXPECT_EQ(end.y, start.y);
    EXPECT_GT(end.z, 3.0);
}

TEST_F(ViewportEdit, TakesAProbeBackWithEscape) {
    const glm::dvec3 start{-8, 4, 1.75};
    view->setProbes({{.id = "p", .position = start}});
    press(pixelOf(start));
    move(pixelOf(start) + QPoint(60, 10), Qt::LeftButton);
    QTest::keyClick(view.get(), Qt::Key_Escape);
    release(pixelOf(start) + QPoint(60, 10));
    ASSERT_EQ(dragged.size(), 2U);
    EXPECT_EQ(std::get<2>(dragged.back()), DragPhase::Cancel);
    EXPECT_EQ(std::get<1>(dragged.back()), start);
}

TEST_F(ViewportEdit, SnapsAProbeToARouteUnlessAltIsHeld) {
    showRoute(false);
    view->setProbes({{.id = "p", .position = {-8, 4, 1.75}}});
    const QPoint to = pixelOf({-12, -4.9, 1.75});
    dragFromTo(pixelOf({-8, 4, 1.75}), to);
    EXPECT_NEAR(std::get<1>(dragged.back()).y, -5.0, 1e-9);
    dragged.clear();
    dragFromTo(pixelOf({-8, 4, 1.75}), to, Qt::LeftButton, Qt::AltModifier);
    EXPECT_NE(std::get<1>(dragged.back()).y, -5.0);
}

TEST_F(ViewportEdit, PlacesProbesOverTheStreetUntilEscape) {
    view->setTool(ViewportTool::PlaceProbe);
    EXPECT_EQ(view->cursor().shape(), Qt::CrossCursor);
    const QPoint first(400, 450), second(600, 500);
    move(first);
    click(first);
    click(second);
    ASSERT_EQ(placed.size(), 2U);
    const glm::dvec3 ground = onPlane(first, 0.0);
    EXPECT_LT(glm::distance(placed[0], ground + glm::dvec3(0, 0, 1.75)), 0.01);
    QTest::keyClick(view.get(), Qt::Key_Escape);
    EXPECT_EQ(view->tool(), ViewportTool::Navigate);
}

TEST_F(ViewportEdit, StillTurnsTheCameraWhileAToolIsChosen) {
    view->setTool(ViewportTool::PlaceProbe);
    dragFromTo({500, 500}, {600, 500});
    EXPECT_TRUE(placed.empty());
    EXPECT_NE(view->camera().position, kStart.position);
}

TEST_F(ViewportEdit, DrawsARouteByClicksAndADoubleClick) {
    view->setTool(ViewportTool::DrawRoute);
    const std::vector<QPoint> at{{250, 500}, {450, 420}, {600, 480}};
    click(at[0]);
    click(at[1]);
    QTest::qWait(QApplication::doubleClickInterval() + 20);
    QTest::mouseClick(view->windowHandle(), Qt::LeftButton, {}, at[2]);
    QTest::mouseDClick(view->windowHandle(), Qt::LeftButton, {}, at[2]);
    ASSERT_EQ(drawn.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LT(glm::distance(drawn[k], onPlane(at[k], 0.0)), 0.01);
    }
    EXPECT_EQ(view->tool(), ViewportTool::Navigate);
}

TEST_F(ViewportEdit, DrawsARouteOfTwoClicksThatWhatComesNextFinishes) {
    QSignalSpy growing(&view->intents(), &EditIntents::routeGrowing);
    view->setTool(ViewportTool::DrawRoute);
    click({250, 500});
    click({600, 480});
    EXPECT_TRUE(drawn.empty());
    view->finishRoute();
    EXPECT_EQ(drawn.size(), 2U);
    ASSERT_EQ(growing.count(), 3);
    EXPECT_EQ(growing[1][0].toInt(), 2);
    EXPECT_EQ(growing[2][0].toInt(), 0);
}

TEST_F(ViewportEdit, TakesTheLastPointBackWithBackspaceAndFinishesWithEnter) {
    view->setTool(ViewportTool::DrawRoute);
    click({250, 500});
    click({450, 420});
    click({700, 600});
    QTest::keyClick(view.get(), Qt::Key_Backspace);
    QTest::keyClick(view.get(), Qt::Key_Return);
    EXPECT_EQ(drawn.size(), 2U);
}

TEST_F(ViewportEdit, GivesARouteUpWithEscapeAndThenTheTool) {
    view->setTool(ViewportTool::DrawRoute);
    click({250, 500});
    click({450, 420});
    QTest::keyClick(view.get(), Qt::Key_Escape);
    EXPECT_EQ(view->draftedPoints(), 0U);
    EXPECT_EQ(view->tool(), ViewportTool::DrawRoute);
    QTest::keyClick(view.get(), Qt::Key_Escape);
    EXPECT_EQ(view->tool(), ViewportTool::Navigate);
    EXPECT_TRUE(drawn.empty());
}

TEST_F(ViewportEdit, DragsACornerOfTheSelectedRouteAndPutsANewOneIn) {
    showRoute(true);
    const QPoint corner = pixelOf({0, -5, 0});
    dragFromTo(corner, corner + QPoint(30, 20));
    ASSERT_FALSE(dragged.empty());
    EXPECT_EQ(std::get<0>(dragged.back()), "r1");
    EXPECT_LT(glm::distance(std::get<1>(dragged.back()), onPlane(corner + QPoint(30, 20), 0.0)),
              0.1);
    dragged.clear();
    const QPoint middle = pixelOf({-15, -5, 0});
    dragFromTo(middle, middle + QPoint(10, 40));
    ASSERT_FALSE(dragged.empty());
    EXPECT_EQ(std::get<0>(dragged.back()), "r+1");
    EXPECT_EQ(std::get<2>(dragged.back()), DragPhase::End);
}

TEST_F(ViewportEdit, RemovesTheCornerUnderTheMouseWithDelete) {
    showRoute(true);
    QSignalSpy removed(&view->intents(), &EditIntents::routePointRemoved);
    move(pixelOf({0, -5, 0}));
    EXPECT_EQ(view->cursor().shape(), Qt::OpenHandCursor);
    QTest::keyClick(view.get(), Qt::Key_Delete);
    ASSERT_EQ(removed.count(), 1);
    EXPECT_EQ(removed[0][0].toString(), "r");
    EXPECT_EQ(removed[0][1].toInt(), 1);
}

TEST_F(ViewportEdit, TellsWhereTheMenuWasAskedFor) {
    view->setProbes({{.id = "p", .position = {-8, 4, 1.75}}});
    std::optional<ProjectItem> item;
    QObject::connect(&view->intents(), &EditIntents::contextMenuAt, view.get(),
                     [&](const QPoint&, const std::optional<ProjectItem>& under,
                         const glm::dvec3&) { item = under; });
    click(pixelOf({-8, 4, 1.75}), Qt::RightButton);
    ASSERT_TRUE(item);
    EXPECT_EQ(item->id, "p");
}

TEST_F(ViewportEdit, DragsTheSelectedVehicleAlongItsRoute) {
    showCar();
    view->setSelectedReflector("car");
    const QPoint from = pixelOf({-10, -5, 0.7}), to = pixelOf({3, -5, 0.7});
    dragFromTo(from, to);
    ASSERT_GE(stations.size(), 3U);
    EXPECT_NEAR(stations.back().first, 33.0, 0.5);
    EXPECT_EQ(stations.back().second, DragPhase::End);
}

TEST_F(ViewportEdit, FollowsAVehicleThatIsDoubleClickedUntilEscape) {
    showCar();
    QTest::mouseDClick(view->windowHandle(), Qt::LeftButton, {}, pixelOf({-10, -5, 0.7}));
    EXPECT_EQ(view->followed(), "car");
    EXPECT_TRUE(eventually(
        [&] { return glm::distance(view->camera().target, glm::dvec3(-10, -5, 0.8)) < 0.1; }));
    view->setPlaying(true);
    EXPECT_TRUE(eventually([&] { return view->camera().target.x > -4.0; }));
    EXPECT_GT(view->time(), 0.5);
    view->setPlaying(false);
    QTest::keyClick(view.get(), Qt::Key_Escape);
    EXPECT_TRUE(view->followed().empty());
    EXPECT_LT(glm::distance(view->camera().position, glm::dvec3(0, -5, 0)), 40.0);
}

TEST_F(ViewportEdit, FramesAProbeThatIsDoubleClicked) {
    view->setProbes({{.id = "p", .position = {-8, 4, 1.75}}});
    QTest::mouseDClick(view->windowHandle(), Qt::LeftButton, {}, pixelOf({-8, 4, 1.75}));
    EXPECT_LT(glm::distance(view->camera().position, glm::dvec3(-8, 4, 1.75)), 30.0);
}

}  // namespace
}  // namespace reflet
