// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/BuiltBounds.h"
#include "tests/ui/viewport/ViewportWindow.h"
#include "widgets/viewport/camera/Walker.h"

#include <QAbstractButton>
#include <QSignalSpy>

namespace reflet {
namespace {

using test::BoxCity;
using test::eventually;

class ViewportCamera : public test::ViewportWindow {};

TEST_F(ViewportCamera, OrbitsAboutThePointUnderTheMouse) {
    const QPoint from(620, 420);
    const glm::dvec3 pivot = onPlane(from, 0.0);
    dragFromTo(from, {470, 360});
    EXPECT_NE(view->camera().position, kStart.position);
    EXPECT_NEAR(glm::distance(view->camera().position, pivot),
                glm::distance(kStart.position, pivot), 1e-6);
    EXPECT_LE((pixelOf(pivot) - from).manhattanLength(), 1);
    EXPECT_NEAR(view->geometry().right().z, 0.0, 1e-12);
}

TEST_F(ViewportCamera, PansWithTheRightButtonSoThatTheGroundStaysUnderTheMouse) {
    const QPoint from(300, 500), to(420, 450);
    const glm::dvec3 grabbed = onPlane(from, 0.0);
    dragFromTo(from, to, Qt::RightButton);
    EXPECT_LE((pixelOf(grabbed) - to).manhattanLength(), 1);
    EXPECT_NEAR(view->camera().position.z, kStart.position.z, 1e-9);
}

TEST_F(ViewportCamera, PansWithShiftAndTheLeftButton) {
    const QPoint from(300, 500), to(420, 450);
    const glm::dvec3 grabbed = onPlane(from, 0.0);
    dragFromTo(from, to, Qt::LeftButton, Qt::ShiftModifier);
    EXPECT_LE((pixelOf(grabbed) - to).manhattanLength(), 1);
}

TEST_F(ViewportCamera, ZoomsToThePointUnderTheMouseAndNeverThroughIt) {
    const QPoint at(300, 500);
    const glm::dvec3 point = onPlane(at, 0.0);
    wheel(at, 3);
    EXPECT_LT(glm::distance(view->camera().position, point),
              0.6 * glm::distance(kStart.position, point));
    EXPECT_LE((pixelOf(point) - at).manhattanLength(), 1);
    for (int k = 0; k < 60; ++k) {
        wheel(at, 2);
    }
    EXPECT_GT(view->camera().position.z, 0.0);
    wheel(at, -20);
    EXPECT_GT(glm::distance(view->camera().position, point), 20.0);
}

TEST_F(ViewportCamera, GoesBackWhereItWasWhenEscapeIsPressedDuringADrag) {
    press({500, 400});
    move({560, 430}, Qt::LeftButton);
    move({600, 460}, Qt::LeftButton);
    EXPECT_NE(view->camera().position, kStart.position);
    QTest::keyClick(view.get(), Qt::Key_Escape);
    EXPECT_EQ(view->camera().position, kStart.position);
    move({700, 460}, Qt::LeftButton);
    EXPECT_EQ(view->camera().position, kStart.position);
    release({700, 460});
}

TEST_F(ViewportCamera, DoesNotTakeAClickForADrag) {
    QSignalSpy clicks(&view->intents(), &EditIntents::clicked);
    press({500, 600});
    move({502, 601}, Qt::LeftButton);
    release({502, 601});
    EXPECT_EQ(clicks.count(), 1);
    EXPECT_EQ(view->camera().position, kStart.position);
}

TEST_F(ViewportCamera, FramesAllHousesAndTheSelection) {
    QTest::keyClick(view.get(), Qt::Key_Home);
    const ViewGeometry all = view->geometry();
    const Box houses = builtBounds(*BoxCity::make()->heightfield);
    for (const double x : {houses.min.x, houses.max.x}) {
        for (const double y : {houses.min.y, houses.max.y}) {
            const ProjectedPoint corner = all.project({x, y, houses.min.z});
            EXPECT_TRUE(corner.depth > 0 && corner.pixel.x > 0 && corner.pixel.x < all.width());
        }
    }
    view->setProbes({{.id = "p", .position = {5, 3, 1.75}, .selected = true}});
    QTest::keyClick(view.get(), Qt::Key_F);
    EXPECT_LT(glm::distance(view->camera().position, glm::dvec3(5, 3, 1.75)), 30.0);
    EXPECT_LE(
        (pixelOf({5, 3, 1.75}) - QPoint(view->width() / 2, view->height() / 2)).manhattanLength(),
        2);
}

TEST_F(ViewportCamera, LooksDownAndNorthByKeys) {
    QTest::keyClick(view.get(), Qt::Key_7);
    EXPECT_LT(view->geometry().forward().z, -0.999);
    QTest::keyClick(view.get(), Qt::Key_3);
    EXPECT_LT(view->geometry().forward().x, -0.5);
    QTest::keyClick(view.get(), Qt::Key_1);
    EXPECT_GT(view->geometry().forward().y, 0.5);
}

TEST_F(ViewportCamera, TurnsToTheNorthWhenTheCompassIsClicked) {
    dragFromTo({500, 400}, {300, 400});
    EXPECT_GT(std::abs(view->geometry().forward().x), 0.3);
    auto* compass = view->findChild<QAbstractButton*>(QStringLiteral("compass"));
    ASSERT_NE(compass, nullptr);
    QTest::mouseClick(compass, Qt::LeftButton);
    EXPECT_NEAR(view->geometry().forward().x, 0.0, 1e-6);
    EXPECT_GT(view->geometry().forward().y, 0.0);
}

TEST_F(ViewportCamera, FliesUnlessMotionIsReduced) {
    view->setReducedMotion(false);
    const Camera to{{30, -30, 20}, {0, 0, 0}, 0.9};
    view->setCamera(to, true);
    EXPECT_EQ(view->camera().position, kStart.position);
    EXPECT_TRUE(eventually([&] { return view->camera().position == to.position; }));
}

TEST_F(ViewportCamera, WalksOnThePavementByKeysAndStopsAtTheHouse) {
    view->setCamera({{20, 2, 12}, {20, 30, 12}, 0.9}, false);
    QTest::keyClick(view.get(), Qt::Key_W);
    ASSERT_TRUE(view->walking());
    EXPECT_NEAR(view->camera().position.z, kEyeHeight, 1e-6);
    QTest::keyPress(view.get(), Qt::Key_W);
    EXPECT_TRUE(eventually([&] { return view->camera().position.y > 8.0; }));
    QTest::qWait(600);
    QTest::keyRelease(view.get(), Qt::Key_W);
    EXPECT_LT(view->camera().position.y, 10.0) << "the walker is in the house";
    const glm::dvec3 there = view->camera().position;
    QTest::qWait(100);
    EXPECT_EQ(view->camera().position, there) << "the walker goes on by itself";
    QTest::keyPress(view.get(), Qt::Key_Left);
    EXPECT_TRUE(eventually([&] { return view->geometry().forward().x < -0.3; }));
    QTest::keyRelease(view.get(), Qt::Key_Left);
    QSignalSpy left(view.get(), &Viewport::walkingChanged);
    QTest::keyClick(view.get(), Qt::Key_Escape);
    EXPECT_FALSE(view->walking());
    EXPECT_EQ(left.count(), 1);
}

TEST_F(ViewportCamera, LooksAroundWithTheMouseWhileWalking) {
    view->setWalking(true);
    const glm::dvec3 eye = view->camera().position;
    dragFromTo({500, 350}, {700, 350});
    EXPECT_EQ(view->camera().position, eye);
    EXPECT_GT(view->geometry().forward().x, 0.3);
}

TEST_F(ViewportCamera, IsMovedByArrowKeysToo) {
    QTest::keyClick(view.get(), Qt::Key_Right);
    EXPECT_GT(view->camera().position.x, 1.0);
    const double before = glm::length(view->camera().position);
    QTest::keyClick(view.get(), Qt::Key_Plus);
    EXPECT_LT(glm::length(view->camera().position), before);
    const glm::dvec3 forward = view->geometry().forward();
    QTest::keyClick(view.get(), Qt::Key_Left, Qt::ShiftModifier);
    EXPECT_LT(glm::dot(view->geometry().forward(), forward), 0.999);
}

}  // namespace
}  // namespace reflet
