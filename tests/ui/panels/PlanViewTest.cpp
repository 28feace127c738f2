// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/BuiltBounds.h"
#include "tests/ui/Patience.h"
#include "tests/ui/panels/PanelTestSupport.h"
#include "widgets/plan/PlanView.h"

#include <QContextMenuEvent>
#include <QSignalSpy>
#include <QWheelEvent>
#include <optional>
#include <utility>
#include <vector>

namespace reflet {
namespace {

using test::showWidget;

constexpr int kWidth = 720;
constexpr int kHeight = 480;

/// A plan of the street with one probe and one selected route, and what it has said.
class PlanViewTest : public testing::Test {
protected:
    void SetUp() override {
        plan.setFrame(test::streetProject(0).frame, QStringLiteral("Amersfoort / RD New"));
        plan.setHeightfield(test::streetHeightfield());
        plan.setProbes({{"rem-1", {20.0, 3.0, 12.15}, ProbeState::Fresh, false, false, false}});
        const std::vector<glm::dvec3> line{
            {-80.0, -2.0, 8.4}, {0.0, -2.0, 10.0}, {60.0, -40.0, 11.2}};
        plan.setRoutes({{"route-1", line, line, true}});
        showWidget(plan, kWidth, kHeight);
        Box box;
        box.add({-100.0, -66.0, 0.0});
        box.add({100.0, 66.0, 0.0});
        plan.frameBox(box);

        QObject::connect(
            &plan.intents(), &EditIntents::clicked,
            [this](const auto& item, bool extend) { clicks.emplace_back(item, extend); });
        QObject::connect(&plan.intents(), &EditIntents::probePlaced,
                         [this](const glm::dvec3& p) { placed.push_back(p); });
        QObject::connect(&plan.intents(), &EditIntents::probeDragged,
                         [this](const QString&, const glm::dvec3& p, DragPhase phase) {
                             drags.emplace_back(p, phase);
                         });
        QObject::connect(&plan.intents(), &EditIntents::routePointDragged,
                         [this](const QString&, int index, const glm::dvec3& p, DragPhase phase) {
                             lastIndex = index;
                             corners.emplace_back(p, phase);
                         });
        QObject::connect(&plan.intents(), &EditIntents::routePointInserted,
                         [this](const QString&, int index, const glm::dvec3& p, DragPhase phase) {
                             lastIndex = index;
                             inserted.emplace_back(p, phase);
                         });
        QObject::connect(
            &plan.intents(), &EditIntents::routeDrawn,
            [this](const std::vector<glm::dvec3>& points) { routes.push_back(points); });
        QObject::connect(
            &plan, &PlanView::cameraDragged,
            [this](const Camera& camera, DragPhase phase) { cameras.emplace_back(camera, phase); });
    }

    [[nodiscard]] QPoint at(double x, double y) const {
        return plan.toWidget({x, y, 0.0}).toPoint();
    }
    void press(const QPoint& point) { QTest::mousePress(&plan, Qt::LeftButton, {}, point); }
    void move(const QPoint& point) { test::moveMouse(plan, point); }
    void release(const QPoint& point) { QTest::mouseRelease(&plan, Qt::LeftButton, {}, point); }
    void click(const QPoint& point, Qt::KeyboardModifiers keys = {}) {
        QTest::mouseClick(&plan, Qt::LeftButton, keys, point);
    }
    /// Half a pixel, in metres.
    [[nodiscard]] double halfPixel() const { return 0.5 / plan.scale() + 1e-9; }
    /// How a drag must read: Begin, any Moves, and one last phase.
    template <class T>
    static void expectSequence(const std::vector<std::pair<T, DragPhase>>& drag, DragPhase last) {
        ASSERT_GE(drag.size(), 2U);
        EXPECT_EQ(drag.front().second, DragPhase::Begin);
        EXPECT_EQ(drag.back().second, last);
        for (std::size_t i = 1; i + 1 < drag.size(); ++i)
            EXPECT_EQ(drag[i].second, DragPhase::Move);
    }

    PlanView plan;
    std::vector<std::pair<std::optional<ProjectItem>, bool>> clicks;
    std::vector<glm::dvec3> placed;
    std::vector<std::pair<glm::dvec3, DragPhase>> drags, corners, inserted;
    std::vector<std::vector<glm::dvec3>> routes;
    std::vector<std::pair<Camera, DragPhase>> cameras;
    int lastIndex = -1;
};

TEST_F(PlanViewTest, AClickInTheProbeToolPlacesAProbeThereToHalfAPixel) {
    plan.setTool(ViewportTool::PlaceProbe);
    click(at(-37.0, 21.0));
    ASSERT_EQ(placed.size(), 1U);
    EXPECT_NEAR(placed[0].x, -37.0, halfPixel());
    EXPECT_NEAR(placed[0].y, 21.0, halfPixel());
    EXPECT_NEAR(placed[0].z, 10.0 + 0.02 * placed[0].x + kNewProbeHeight, 0.01);
    EXPECT_TRUE(clicks.empty());
}

TEST_F(PlanViewTest, PlacesThatAreShownAreFoundAgain) {
    for (const glm::dvec3& p : {glm::dvec3(12.5, -33.25, 0.0), glm::dvec3(-90.0, 60.0, 0.0)}) {
        const glm::dvec3 back = plan.toFrame(plan.toWidget(p));
        EXPECT_NEAR(back.x, p.x, 1e-9);
        EXPECT_NEAR(back.y, p.y, 1e-9);
    }
    EXPECT_GT(plan.toWidget({1.0, 0.0, 0.0}).x(), plan.toWidget({0.0, 0.0, 0.0}).x()) << "east";
    EXPECT_LT(plan.toWidget({0.0, 1.0, 0.0}).y(), plan.toWidget({0.0, 0.0, 0.0}).y()) << "north";
}

TEST_F(PlanViewTest, ClickingAProbeSelectsItAndCtrlExtends) {
    click(at(20.0, 3.0));
    click(at(20.0, 3.0), Qt::ControlModifier);
    click(at(-60.0, 40.0));
    ASSERT_EQ(clicks.size(), 3U);
    EXPECT_EQ(clicks[0],
              std::pair(std::optional(ProjectItem{ProjectItem::Kind::Probe, "rem-1"}), false));
    EXPECT_TRUE(clicks[1].second);
    EXPECT_FALSE(clicks[2].first.has_value());
}

TEST_F(PlanViewTest, DraggingAProbeGivesOneSequenceAndKeepsItsHeightAboveGround) {
    press(at(20.0, 3.0));
    for (int step = 1; step <= 6; ++step)
        move(at(20.0 + 5.0 * step, 3.0));
    release(at(50.0, 3.0));
    expectSequence(drags, DragPhase::End);
    EXPECT_NEAR(drags.back().first.x, 50.0, 2.0 * halfPixel());
    EXPECT_NEAR(drags.back().first.y, 3.0, 2.0 * halfPixel());
    EXPECT_NEAR(drags.back().first.z - (10.0 + 0.02 * drags.back().first.x), 1.75, 0.02);
    ASSERT_EQ(clicks.size(), 1U) << "an unselected probe is selected when its drag begins";
}

TEST_F(PlanViewTest, EscapeTakesADragBackAndTheReleaseSaysNothingMore) {
    press(at(20.0, 3.0));
    move(at(30.0, 10.0));
    move(at(35.0, 15.0));
    QTest::keyClick(&plan, Qt::Key_Escape);
    const std::size_t before = drags.size();
    release(at(40.0, 20.0));
    EXPECT_EQ(drags.size(), before);
    expectSequence(drags, DragPhase::Cancel);
    EXPECT_NEAR(drags.back().first.x, 20.0, 1e-9);
    EXPECT_NEAR(drags.back().first.y, 3.0, 1e-9);
}

TEST_F(PlanViewTest, ClicksAndEnterDrawARouteAndBackspaceTakesAPointBack) {
    plan.setTool(ViewportTool::DrawRoute);
    click(at(-50.0, 0.0));
    click(at(10.0, 30.0));
    QTest::keyClick(&plan, Qt::Key_Backspace);
    click(at(40.0, 0.0));
    QTest::keyClick(&plan, Qt::Key_Return);
    ASSERT_EQ(routes.size(), 1U);
    ASSERT_EQ(routes[0].size(), 2U);
    EXPECT_NEAR(routes[0][0].x, -50.0, halfPixel());
    EXPECT_NEAR(routes[0][1].x, 40.0, halfPixel());
    EXPECT_NEAR(routes[0][1].z, 10.0 + 0.02 * routes[0][1].x, 0.01) << "on the ground";
    EXPECT_EQ(plan.tool(), ViewportTool::Navigate);
}

TEST_F(PlanViewTest, ADoubleClickEndsARouteWithThePointItIsOn) {
    plan.setTool(ViewportTool::DrawRoute);
    click(at(-50.0, 0.0));
    click(at(40.0, 20.0));
    QTest::mouseDClick(&plan, Qt::LeftButton, {}, at(40.0, 20.0));
    ASSERT_EQ(routes.size(), 1U);
    EXPECT_EQ(routes[0].size(), 2U);
}

TEST_F(PlanViewTest, EscapeGivesUpTheRouteFirstAndThenTheTool) {
    const QSignalSpy tools(&plan.intents(), &EditIntents::toolChanged);
    plan.setTool(ViewportTool::DrawRoute);
    click(at(-50.0, 0.0));
    QTest::keyClick(&plan, Qt::Key_Escape);
    EXPECT_EQ(plan.tool(), ViewportTool::DrawRoute);
    QTest::keyClick(&plan, Qt::Key_Escape);
    EXPECT_EQ(plan.tool(), ViewportTool::Navigate);
    EXPECT_EQ(tools.count(), 1) << "only what the user does is reported";
    QTest::keyClick(&plan, Qt::Key_Return);
    EXPECT_TRUE(routes.empty());
}

TEST_F(PlanViewTest, ARouteIsDrawnWithKeysAlone) {
    plan.setTool(ViewportTool::DrawRoute);
    QTest::keyClick(&plan, Qt::Key_Left);
    QTest::keyClick(&plan, Qt::Key_Space);
    for (int i = 0; i < 5; ++i)
        QTest::keyClick(&plan, Qt::Key_Right);
    QTest::keyClick(&plan, Qt::Key_Space);
    QTest::keyClick(&plan, Qt::Key_Return);
    ASSERT_EQ(routes.size(), 1U);
    ASSERT_EQ(routes[0].size(), 2U);
    EXPECT_GT(routes[0][1].x, routes[0][0].x);
    EXPECT_NEAR(routes[0][1].y, routes[0][0].y, 1e-9);
}

TEST_F(PlanViewTest, ACornerIsDraggedAndAnEdgesMiddleBecomesOne) {
    press(at(0.0, -2.0));
    move(at(5.0, 10.0));
    move(at(8.0, 16.0));
    release(at(8.0, 16.0));
    expectSequence(corners, DragPhase::End);
    EXPECT_EQ(lastIndex, 1);
    EXPECT_NEAR(corners.back().first.x, 8.0, 2.0 * halfPixel());

    press(at(-40.0, -2.0));
    move(at(-40.0, 8.0));
    move(at(-40.0, 14.0));
    release(at(-40.0, 14.0));
    expectSequence(inserted, DragPhase::End);
    EXPECT_EQ(lastIndex, 1) << "before the handle that the edge ended at";
    EXPECT_NEAR(inserted.back().first.y, 14.0, 2.0 * halfPixel());
}

TEST_F(PlanViewTest, DeleteRemovesTheChosenCornerElseTheSelection) {
    const QSignalSpy removedCorners(&plan.intents(), &EditIntents::routePointRemoved);
    const QSignalSpy removed(&plan.intents(), &EditIntents::removeRequested);
    QTest::keyClick(&plan, Qt::Key_Delete);
    EXPECT_EQ(removed.count(), 1);
    click(at(0.0, -2.0));
    QTest::keyClick(&plan, Qt::Key_Delete);
    EXPECT_EQ(removed.count(), 1);
    ASSERT_EQ(removedCorners.count(), 1);
    EXPECT_EQ(removedCorners[0][0].toString(), QStringLiteral("route-1"));
    EXPECT_EQ(removedCorners[0][1].toInt(), 1);
}

TEST_F(PlanViewTest, TheWheelKeepsWhatIsUnderTheCursorThere) {
    const QPoint point(500, 120);
    const glm::dvec3 before = plan.toFrame(point);
    const double scale = plan.scale();
    QWheelEvent wheel(point, plan.mapToGlobal(point), {}, {0, 240}, Qt::NoButton, {},
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&plan, &wheel);
    EXPECT_GT(plan.scale(), 1.2 * scale);
    EXPECT_NEAR(plan.toFrame(point).x, before.x, 1e-6);
    EXPECT_NEAR(plan.toFrame(point).y, before.y, 1e-6);
    QTest::keyClick(&plan, Qt::Key_Home);
    const Box houses = builtBounds(*test::streetHeightfield());
    EXPECT_TRUE(plan.rect().contains(plan.toWidget(houses.min).toPoint()));
    EXPECT_TRUE(plan.rect().contains(plan.toWidget(houses.max).toPoint()));
}

TEST_F(PlanViewTest, DraggingTheGroundMovesTheViewAndSaysNothing) {
    const glm::dvec3 grabbed = plan.toFrame(QPointF(600.0, 60.0));
    press({600, 60});
    move({560, 80});
    move({500, 100});
    release({500, 100});
    EXPECT_NEAR(plan.toFrame(QPointF(500.0, 100.0)).x, grabbed.x, halfPixel());
    EXPECT_NEAR(plan.toFrame(QPointF(500.0, 100.0)).y, grabbed.y, halfPixel());
    EXPECT_TRUE(clicks.empty());
    EXPECT_TRUE(drags.empty());
}

TEST_F(PlanViewTest, TheCamerasEyeIsDraggedOverTheGround) {
    Camera camera;
    camera.position = {-60.0, 40.0, 10.4};
    camera.target = {-40.0, 40.0, 10.0};
    plan.setCamera(camera);
    press(at(-60.0, 40.0));
    move(at(-50.0, 45.0));
    move(at(-10.0, 50.0));
    release(at(-10.0, 50.0));
    expectSequence(cameras, DragPhase::End);
    const Camera& last = cameras.back().first;
    EXPECT_NEAR(last.position.x, -10.0, 2.0 * halfPixel());
    EXPECT_NEAR(last.position.z - (10.0 + 0.02 * last.position.x), 1.6, 0.02);
    EXPECT_NEAR(last.target.x - last.position.x, 20.0, 1e-9) << "it looks the same way";
}

TEST_F(PlanViewTest, RoofsAndGroundHaveDifferentColoursInThePicture) {
    const QSignalSpy ready(&plan, &PlanView::pictureReady);
    plan.setHeightfield(test::streetHeightfield());
    ASSERT_TRUE(QTest::qWaitFor([&] { return ready.count() > 0; }, test::kPatience));
    plan.setRoutes({});
    plan.setProbes({});
    const QImage image = plan.grab().toImage();
    const QColor street = image.pixelColor(at(50.0, 3.0));
    const QColor roof = image.pixelColor(at(50.0, 30.0));
    EXPECT_GT(roof.red() - roof.blue(), street.red() - street.blue() + 20)
        << "roofs are warm, streets are not";
}

TEST_F(PlanViewTest, APlanThatNobodySeesIsPaintedAndFramedWhenItIsShown) {
    PlanView hidden;
    const QSignalSpy ready(&hidden, &PlanView::pictureReady);
    hidden.resize(kWidth, kHeight);
    hidden.setHeightfield(test::streetHeightfield());
    const QSignalSpy seen(&plan, &PlanView::pictureReady);
    plan.setHeightfield(test::streetHeightfield());
    ASSERT_TRUE(QTest::qWaitFor([&] { return seen.count() > 0; }, test::kPatience))
        << "one that is seen is painted";
    EXPECT_EQ(ready.count(), 0);
    showWidget(hidden, kWidth, kHeight);
    ASSERT_TRUE(QTest::qWaitFor([&] { return ready.count() > 0; }, test::kPatience));
    EXPECT_EQ(ready.count(), 1);
    const Box houses = builtBounds(*test::streetHeightfield());
    EXPECT_TRUE(hidden.rect().contains(hidden.toWidget(houses.min).toPoint()));
    EXPECT_TRUE(hidden.rect().contains(hidden.toWidget(houses.max).toPoint()));
    EXPECT_GT(hidden.scale() * houses.size().x, 0.4 * kWidth) << "and it fills the plan";
}

}  // namespace
}  // namespace reflet
