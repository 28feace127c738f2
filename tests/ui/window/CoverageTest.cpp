// SPDX-License-Identifier: GPL-3.0-or-later
// Coverage and suggested probes in the whole window, with mouse and keyboard.
#include "app/shell/Commands.h"
#include "app/shell/MainWindow.h"
#include "app/shell/coverage/DriveWatch.h"
#include "tests/ui/window/WindowTestSupport.h"
#include "widgets/coverage/CoverageLook.h"
#include "widgets/coverage/CoveragePanel.h"
#include "widgets/preview/MapPreview.h"

#include <QAction>
#include <QContextMenuEvent>
#include <QLabel>
#include <QMenu>
#include <QSpinBox>
#include <QTreeWidget>
#include <QUndoStack>
#include <algorithm>
#include <cmath>
#include <optional>

namespace reflet::test {
namespace {

class CoverageTest : public WindowTest {
protected:
    /// A route along the whole street, and one probe near its west end.
    void SetUp() override {
        window.emplace();
        open(*window, city);
        if (HasFatalFailure())
            return;
        ProjectDocument& document = window->document();
        const glm::dvec3 origin = document.project().frame.origin;
        document.addRoute({origin + onRoad(4.0), origin + onRoad(56.0)});
        document.addProbe(origin + onRoad(10.0) + glm::dvec3(0.0, 0.0, 1.75));
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                const auto prepared = window->bench().live->prepared();
                return prepared && prepared->project().probes.size() == 1;
            },
            kPatience));
        window->bench().commands->action(Command::Navigate)->trigger();
        window->bench().plan->frameAll();
    }
    void TearDown() override {
        if (window)
            window->document().undoStack()->setClean();
    }
    [[nodiscard]] glm::dvec3 onRoad(double x) const {
        const auto& grid = window->bench().live->city()->heightfield->grid;
        return {grid.x0 + x, 0.5 * (grid.y0 + grid.yMax()), 0.0};
    }
    template <class T>
    T* part(const char* name) const {
        auto* found = window->bench().coverage->findChild<T*>(QString::fromLatin1(name));
        EXPECT_NE(found, nullptr) << name;
        return found;
    }
    [[nodiscard]] QString total() const { return part<QLabel>("coverageTotal")->text(); }
    [[nodiscard]] double percent() const {
        return total().section(QLatin1Char(' '), 0, 0).toDouble();
    }
    void measure() {
        QTest::keyClick(window->bench().plan, Qt::Key_V);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !total().isEmpty(); }, kPatience));
    }
    void suggest(int count) {
        part<QComboBox>("suggestKind")->setCurrentIndex(1);
        part<QSpinBox>("suggestCount")->setValue(count);
        QTest::mouseClick(part<QPushButton>("suggestProbes"), Qt::LeftButton);
        ASSERT_TRUE(QTest::qWaitFor([&] { return accepts(); }, kPatience));
    }
    [[nodiscard]] bool accepts() const {
        return window->bench().commands->action(Command::AcceptSuggestions)->isEnabled();
    }
    [[nodiscard]] const std::vector<Probe>& probes() { return window->document().project().probes; }
    /// Pixels of the plan in the colour of suggested probes.
    [[nodiscard]] std::vector<QPoint> ghostPixels() const {
        const QImage image = window->bench().plan->grab().toImage();
        const QColor tone = ghostTone();
        std::vector<QPoint> found;
        // The legend in the corner shows one too.
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                if (image.pixel(x, y) == tone.rgb() && (x > 230 || y > 130))
                    found.emplace_back(x, y);
        return found;
    }

    std::optional<MainWindow> window;
};

TEST_F(CoverageTest, OneKeyMeasuresAndColoursTheRoutesAndAnotherPressHidesThem) {
    measure();
    EXPECT_GT(percent(), 5.0);
    EXPECT_LT(percent(), 99.0);
    EXPECT_TRUE(window->bench().coverage->isVisible());
    EXPECT_GE(part<QTreeWidget>("coverageTree")->topLevelItemCount(), 3)
        << "routes, worst places, probes";
    QAction* shown = window->bench().commands->action(Command::CoverageShown);
    EXPECT_TRUE(shown->isChecked());
    const QImage with = window->bench().plan->grab().toImage();
    QTest::keyClick(window->bench().plan, Qt::Key_V);
    EXPECT_FALSE(shown->isChecked());
    EXPECT_NE(window->bench().plan->grab().toImage(), with);
}

TEST_F(CoverageTest, SuggestedProbesAreTakenByEnterAsOneStepAndUndoBringsTheGhostsBack) {
    measure();
    const double before = percent();
    const std::string file = json(*window);
    suggest(3);
    const QString sentence = part<QLabel>("suggestionSentence")->text();
    EXPECT_TRUE(sentence.contains("exceed")) << sentence.toStdString();
    EXPECT_FALSE(ghostPixels().empty());
    const int step = window->document().undoStack()->index();
    window->bench().plan->setFocus();
    QTest::keyClick(window->bench().plan, Qt::Key_Return);
    EXPECT_EQ(probes().size(), 4U);
    EXPECT_EQ(window->document().undoStack()->index(), step + 1);
    EXPECT_TRUE(QTest::qWaitFor([&] { return percent() > before + 1.0; }, kPatience))
        << "the coverage follows: " << total().toStdString();
    EXPECT_TRUE(ghostPixels().empty());
    window->document().undoStack()->undo();
    EXPECT_EQ(json(*window), file);
    EXPECT_FALSE(ghostPixels().empty());
}

TEST_F(CoverageTest, AClickOnAGhostAcceptsThatOneAndEscapeTakesTheOthersAway) {
    suggest(2);
    const auto pixels = ghostPixels();
    ASSERT_FALSE(pixels.empty());
    const std::size_t before = probes().size();
    click(*window->bench().plan, pixels[pixels.size() / 2]);
    EXPECT_EQ(probes().size(), before + 1);
    EXPECT_TRUE(accepts()) << "one is left";
    window->bench().plan->setFocus();
    QTest::keyClick(window->bench().plan, Qt::Key_Escape);
    EXPECT_FALSE(accepts());
    EXPECT_TRUE(ghostPixels().empty());
    EXPECT_EQ(probes().size(), before + 1);
}

TEST_F(CoverageTest, TheCoverageFollowsAProbeWhileItIsDragged) {
    measure();
    const QString before = total();
    PlanView& plan = *window->bench().plan;
    const QPoint from = inPlan(*window, onRoad(10.0));
    const QPoint to = inPlan(*window, onRoad(32.0));
    QTest::mousePress(&plan, Qt::LeftButton, {}, from);
    for (int step = 1; step <= 8; ++step)
        moveMouse(plan, from + step * (to - from) / 8);
    EXPECT_TRUE(QTest::qWaitFor([&] { return total() != before; }, kPatience))
        << "before the button is released";
    QTest::mouseRelease(&plan, Qt::LeftButton, {}, to);
    EXPECT_NEAR(probes().front().position.x - window->document().project().frame.origin.x,
                onRoad(32.0).x, 1.0);
}

TEST_F(CoverageTest, TheMenuOverTheGroundSuggestsAProbeNearThere) {
    PlanView& plan = *window->bench().plan;
    const QPoint spot = inPlan(*window, onRoad(48.0));
    QContextMenuEvent event(QContextMenuEvent::Mouse, spot, plan.mapToGlobal(spot));
    QApplication::sendEvent(&plan, &event);
    auto* menu = window->findChild<QMenu*>(QStringLiteral("contextMenu"));
    ASSERT_NE(menu, nullptr);
    auto* here = menu->findChild<QAction*>(QStringLiteral("suggestHere"));
    ASSERT_NE(here, nullptr);
    here->trigger();
    menu->close();
    ASSERT_TRUE(QTest::qWaitFor([&] { return accepts(); }, kPatience));
    QTest::keyClick(&plan, Qt::Key_Return);
    ASSERT_EQ(probes().size(), 2U);
    const glm::dvec3 place = probes().back().position - window->document().project().frame.origin;
    EXPECT_LT(std::abs(place.x - onRoad(48.0).x), 30.0);
}

TEST_F(CoverageTest, AChangedRouteMakesTheFiguresOldAndHidesTheMap) {
    measure();
    RouteSpec route = window->document().project().routes.front();
    route.points.back().x -= 15.0;
    window->document().setRoute(route);
    EXPECT_FALSE(window->bench().commands->action(Command::CoverageShown)->isChecked());
    EXPECT_TRUE(part<QLabel>("coverageStale")->isVisible());
    QTest::keyClick(window->bench().plan, Qt::Key_V);
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return !part<QLabel>("coverageStale")->isVisible(); }, kPatience));
}

/// The same with a tram, and with the probe's picture.
class DrivingCoverageTest : public CoverageTest {
protected:
    void SetUp() override {
        CoverageTest::SetUp();
        if (HasFatalFailure())
            return;
        tram =
            window->document().addReflector("tram", window->document().project().routes.front().id);
        LiveCity& live = *window->bench().live;
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                return live.traffic()->size() == 1 && !live.rems().empty() &&
                       live.probesToBake() == 0;
            },
            kPatience));
    }
    std::string tram;
};

TEST_F(DrivingCoverageTest, WhatADriveMirrorsAndNoProbeSeesIsOfferedAsASuggestion) {
    window->bench().viewport->setPlaying(true);
    FrameStatistics much;
    much.vertices = 1'000'000'000;  // more than what the pictures themselves tell
    much.uncovered = 300'000'000;
    auto* drive = window->findChild<DriveWatch*>();
    ASSERT_NE(drive, nullptr);
    auto* messages = window->findChild<QWidget*>(QStringLiteral("messageBar"));
    QPushButton* here = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            drive->count(much);
            for (auto* button : messages->findChildren<QPushButton*>())
                here = button->text() == QStringLiteral("Suggest here") ? button : here;
            return here != nullptr;
        },
        kPatience));
    QStringList texts;
    for (const auto* label : messages->findChildren<QLabel*>())
        texts << label->text();
    EXPECT_TRUE(texts.join(QLatin1Char(' ')).contains("30 %")) << texts.join(' ').toStdString();
    window->bench().viewport->setPlaying(false);
    here->click();
    EXPECT_TRUE(QTest::qWaitFor([&] { return accepts(); }, kPatience));
}

TEST_F(DrivingCoverageTest, ADriveThatProbesSeeIsNotTalkedAbout) {
    window->bench().viewport->setPlaying(true);
    FrameStatistics little;
    little.vertices = 1'000'000'000;
    little.uncovered = 50'000'000;
    auto* drive = window->findChild<DriveWatch*>();
    ASSERT_NE(drive, nullptr);
    for (int i = 0; i < 20; ++i) {
        drive->count(little);
        QTest::qWait(100);
    }
    auto* messages = window->findChild<QWidget*>(QStringLiteral("messageBar"));
    for (auto* button : messages->findChildren<QPushButton*>())
        EXPECT_NE(button->text(), QStringLiteral("Suggest here"));
}

TEST_F(DrivingCoverageTest, TheMapTellsWhichProbeShowsADirectionAndForgetsItOutside) {
    window->bench().viewport->setPlaying(false);
    window->document().selection()->set({ProjectItem::Kind::Reflector, tram});
    MapPreview& preview = *window->bench().preview;
    auto* words = preview.findChild<QLabel*>(QStringLiteral("mapExplanation"));
    ASSERT_NE(words, nullptr);
    Q_EMIT preview.directionHovered({0.0, 0.0, 1.0});
    EXPECT_TRUE(words->text().contains(QString::fromStdString(probes().front().id) +
                                       QStringLiteral(" shows it, weight 100 %")))
        << words->text().toStdString();
    Q_EMIT preview.directionLeft();
    EXPECT_TRUE(words->text().isEmpty());
}

}  // namespace
}  // namespace reflet::test
