// SPDX-License-Identifier: GPL-3.0-or-later
// A planner's way through the whole window, with mouse and keyboard.
#include "app/shell/MainWindow.h"
#include "tests/ui/window/WindowTestSupport.h"
#include "widgets/common/DragSlider.h"
#include "widgets/tuning/TuningPanel.h"
#include "widgets/viewport/Viewport.h"

#include <QDialog>
#include <QImage>
#include <QUndoStack>
#include <algorithm>
#include <cmath>

namespace reflet::test {
namespace {

class PlanningTest : public WindowTest {
protected:
    /// Positions on the road, metres from its west end, project frame.
    static glm::dvec3 onRoad(const MainWindow& window, double x) {
        const auto box = window.bench().live->city()->heightfield->grid;
        return {box.x0 + x, 0.5 * (box.y0 + box.yMax()), 0.0};
    }
    static void drawRoute(MainWindow& window) {
        PlanView& plan = *window.bench().plan;
        ASSERT_EQ(plan.tool(), ViewportTool::DrawRoute) << "a city of one's own begins with it";
        click(plan, inPlan(window, onRoad(window, 12.0)));
        click(plan, inPlan(window, onRoad(window, 55.0)));
        QTest::keyClick(&plan, Qt::Key_Return);
        ASSERT_EQ(window.document().project().routes.size(), 1U);
    }
    static void placeProbe(MainWindow& window, double x) {
        PlanView& plan = *window.bench().plan;
        const std::size_t before = window.document().project().probes.size();
        QTest::keyClick(window.bench().plan, Qt::Key_P);
        ASSERT_EQ(plan.tool(), ViewportTool::PlaceProbe);
        click(plan, inPlan(window, onRoad(window, x)));
        QTest::keyClick(&plan, Qt::Key_Escape);
        ASSERT_EQ(window.document().project().probes.size(), before + 1);
    }
};

TEST_F(PlanningTest, ARouteIsDrawnInThePlanWithTwoClicksAndEnter) {
    MainWindow window;
    open(window, city);
    if (HasFatalFailure())
        return;
    drawRoute(window);
    if (HasFatalFailure())
        return;
    const RouteSpec& route = window.document().project().routes.front();
    ASSERT_EQ(route.points.size(), 2U);
    EXPECT_NEAR(glm::length(route.points[1] - route.points[0]), 43.0, 1.0);
    QTest::keyClick(window.bench().plan, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(window.document().project().routes.empty());
    QTest::keyClick(window.bench().plan, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(window.document().project().routes.size(), 1U);
    window.document().undoStack()->setClean();
}

TEST_F(PlanningTest, MovingAProbeIsOneStepAndUndoRestoresTheVeryFile) {
    MainWindow window;
    open(window, city);
    if (HasFatalFailure())
        return;
    placeProbe(window, 30.0);
    if (HasFatalFailure())
        return;
    const std::string before = json(window);
    const int steps = window.document().undoStack()->index();
    PlanView& plan = *window.bench().plan;
    const QPoint from = inPlan(window, onRoad(window, 30.0));
    QTest::mousePress(&plan, Qt::LeftButton, {}, from);
    for (int step = 1; step <= 8; ++step)
        moveMouse(plan, from + QPoint(5 * step, 0));
    QTest::mouseRelease(&plan, Qt::LeftButton, {}, from + QPoint(40, 0));
    const std::string after = json(window);
    EXPECT_NE(after, before);
    EXPECT_EQ(window.document().undoStack()->index(), steps + 1);
    QTest::keyClick(window.bench().plan, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(json(window), before);
    QTest::keyClick(window.bench().plan, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(json(window), after);
    window.document().undoStack()->setClean();
}

TEST_F(PlanningTest, EscapeDuringADragLeavesNoTraceInTheHistory) {
    MainWindow window;
    open(window, city);
    if (HasFatalFailure())
        return;
    placeProbe(window, 30.0);
    if (HasFatalFailure())
        return;
    const std::string before = json(window);
    PlanView& plan = *window.bench().plan;
    const QPoint from = inPlan(window, onRoad(window, 30.0));
    QTest::mousePress(&plan, Qt::LeftButton, {}, from);
    moveMouse(plan, from + QPoint(20, 5));
    moveMouse(plan, from + QPoint(40, 9));
    EXPECT_NE(json(window), before) << "it moves while it is dragged";
    QTest::keyClick(&plan, Qt::Key_Escape);
    QTest::mouseRelease(&plan, Qt::LeftButton, {}, from + QPoint(40, 9));
    EXPECT_EQ(json(window), before);
    window.document().undoStack()->setClean();
}

TEST_F(PlanningTest, TwoClicksAndMakeItReflectGiveAVehicleWithProbesAndUndoTakesAllBack) {
    MainWindow window;
    open(window, city);
    if (HasFatalFailure())
        return;
    const std::string before = json(window);
    PlanView& plan = *window.bench().plan;
    QTest::keyClick(&plan, Qt::Key_R);  // puts the tool down that a new city comes with
    EXPECT_EQ(plan.tool(), ViewportTool::Navigate);
    QTest::keyClick(&plan, Qt::Key_R);
    ASSERT_EQ(plan.tool(), ViewportTool::DrawRoute);
    click(plan, inPlan(window, onRoad(window, 5.0)));
    click(plan, inPlan(window, onRoad(window, 58.0)));
    QTest::keyClick(&plan, Qt::Key_M);
    const auto& project = window.document().project();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !project.reflectors.empty(); }, kPatience));
    EXPECT_EQ(project.routes.size(), 1U);
    ASSERT_FALSE(project.probes.empty());
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
            return std::all_of(project.probes.begin(), project.probes.end(), [&](const auto& p) {
                return window.bench().live->probeState(p.id) == ProbeState::Fresh;
            });
        },
        kPatience))
        << "the probes are baked in the background";
    const std::string after = json(window);
    QUndoStack& history = *window.document().undoStack();
    while (history.canUndo())
        QTest::keyClick(&plan, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(json(window), before);
    while (history.canRedo())
        QTest::keyClick(&plan, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(json(window), after);
    history.setClean();
}

TEST_F(PlanningTest, DetailAtEdgesReachesBothEndsInTheProject) {
    MainWindow window;
    open(window, city);
    if (HasFatalFailure())
        return;
    auto* slider = window.bench().tuning->findChild<DragSlider*>(QStringLiteral("detailSlider"));
    ASSERT_NE(slider, nullptr);
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_Home);
    EXPECT_TRUE(std::isinf(window.document().project().tuning.depthRatio));
    QTest::keyClick(slider, Qt::Key_End);
    EXPECT_EQ(window.document().project().tuning.depthRatio, 0.0);
    window.document().undoStack()->setClean();
}

TEST_F(PlanningTest, WhatIsSavedIsWhatIsOpenedAgain) {
    const auto file = folder / "street.reflet";
    std::string saved;
    {
        MainWindow window;
        open(window, city);
        if (HasFatalFailure())
            return;
        drawRoute(window);
        placeProbe(window, 40.0);
        if (HasFatalFailure())
            return;
        QTest::keyClick(window.bench().plan, Qt::Key_S, Qt::ControlModifier);
        answerFileDialog(window, "saveDialog", file);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !window.isWindowModified(); }, kPatience));
        saved = json(window);
    }
    MainWindow again;
    open(again, file);
    EXPECT_EQ(json(again), saved);
    EXPECT_EQ(again.document().project().probes.size(), 1U);
    EXPECT_EQ(again.document().project().routes.size(), 1U);
}

TEST_F(PlanningTest, APictureIsSavedAndShowsSomething) {
    MainWindow window;
    open(window, city);
    if (HasFatalFailure())
        return;
    QTest::keyClick(window.bench().plan, Qt::Key_P, Qt::ControlModifier);
    QDialog* dialog = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            dialog = window.findChild<QDialog*>(QStringLiteral("pictureDialog"));
            return dialog && dialog->isVisible();
        },
        kPatience));
    QTest::keyClick(dialog, Qt::Key_Return);
    const auto file = folder / "street.png";
    answerFileDialog(window, "pictureFileDialog", file);
    QImage image;
    ASSERT_TRUE(QTest::qWaitFor([&] { return image.load(QString::fromStdString(file.string())); },
                                kPatience));
    QRgb darkest = 0xFFFFFFFF, brightest = 0xFF000000;
    for (int y = 0; y < image.height(); y += 7) {
        for (int x = 0; x < image.width(); x += 7) {
            if (qGray(image.pixel(x, y)) < qGray(darkest))
                darkest = image.pixel(x, y);
            if (qGray(image.pixel(x, y)) > qGray(brightest))
                brightest = image.pixel(x, y);
        }
    }
    EXPECT_GT(qGray(brightest) - qGray(darkest), 60) << "neither black nor one colour";
    window.document().undoStack()->setClean();
}

}  // namespace
}  // namespace reflet::test
