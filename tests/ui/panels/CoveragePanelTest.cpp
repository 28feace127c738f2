// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/overlay/CoverageOverlay.h"
#include "tests/ui/panels/PanelTestSupport.h"
#include "widgets/coverage/CoverageLegend.h"
#include "widgets/coverage/CoverageLook.h"
#include "widgets/coverage/CoveragePanel.h"
#include "widgets/plan/PlanView.h"

#include <QComboBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>

namespace reflet {
namespace {

CoverageFacts someFacts() {
    CoverageFacts facts;
    facts.coverage = {0.834, 0.004};
    facts.seen = {0.962, 0.002};
    facts.seenTwice = {0.71, 0.003};
    facts.shown = Estimate{0.812, 0.004};
    LineFigures figures;
    figures.length = 420.0;
    figures.coverage = 0.834;
    figures.worst = 0.31;
    figures.worstStation = 125.0;
    figures.p05 = 0.44;
    figures.largestGap = 20.0;
    facts.routes = {{QStringLiteral("Main street"), figures, {125.0, 0.0, 0.0}}};
    facts.worst = {{QStringLiteral("Main street, 120 to 130 m"), 0.31, {125.0, 1.0, 2.0}}};
    facts.facades = {{QStringLiteral("house-7"), 84.0, 120.0, {100.0, 9.0, 4.0}}};
    facts.probes = {{QStringLiteral("p01"), 0.21, 0.05}, {QStringLiteral("p02"), 0.001, 0.0}};
    facts.reflectedWalls = 5000.0;
    facts.uncoveredWalls = 84.0;
    return facts;
}

class CoveragePanelTest : public testing::Test {
protected:
    void SetUp() override {
        panel.setPossible(true);
        test::showWidget(panel, 320, 900);
    }
    [[nodiscard]] QTreeWidgetItem* row(const QString& text) const {
        for (QTreeWidgetItemIterator it(test::child<QTreeWidget>(panel, "coverageTree")); *it; ++it)
            if ((*it)->text(0) == text)
                return *it;
        return nullptr;
    }
    void click(QTreeWidgetItem* item) {
        auto* tree = test::child<QTreeWidget>(panel, "coverageTree");
        tree->scrollToItem(item);
        QTest::mouseClick(tree->viewport(), Qt::LeftButton, {},
                          tree->visualItemRect(item).center());
    }
    void press(const char* name) {
        QTest::mouseClick(test::child<QPushButton>(panel, name), Qt::LeftButton);
    }

    CoveragePanel panel;
};

TEST_F(CoveragePanelTest, TellsTheTotalWithItsErrorAndWhatIsSeenAndShown) {
    panel.setFacts(someFacts());
    EXPECT_EQ(test::child<QLabel>(panel, "coverageTotal")->text(), "83.4 % ± 0.4 %");
    const QString details = test::child<QLabel>(panel, "coverageDetails")->text();
    EXPECT_TRUE(details.contains("96.2 %")) << details.toStdString();
    EXPECT_TRUE(details.contains("71.0 %")) << details.toStdString();
    EXPECT_TRUE(details.contains("81.2 % ± 0.4 %")) << details.toStdString();
    QTest::qWait(50);
    EXPECT_TRUE(test::clippedTexts(panel).empty()) << test::clippedTexts(panel).front();
}

TEST_F(CoveragePanelTest, ARouteTellsItsLengthWorstPointTwentiethAndGap) {
    panel.setFacts(someFacts());
    QTreeWidgetItem* route = row("Main street");
    ASSERT_NE(route, nullptr);
    EXPECT_EQ(route->text(1), "83.4 %");
    QStringList figures;
    for (int i = 0; i < route->childCount(); ++i)
        figures << route->child(i)->text(1);
    EXPECT_TRUE(figures.contains("420 m"));
    EXPECT_TRUE(figures.contains("31.0 %"));
    EXPECT_TRUE(figures.contains("44.0 %"));
    EXPECT_TRUE(figures.contains("20 m"));
}

TEST_F(CoveragePanelTest, AClickOnAPlaceGoesThereAndOnAProbeToIt) {
    panel.setFacts(someFacts());
    std::vector<glm::dvec3> places;
    QObject::connect(&panel, &CoveragePanel::placeActivated,
                     [&](const glm::dvec3& place) { places.push_back(place); });
    const QSignalSpy probes(&panel, &CoveragePanel::probeActivated);
    click(row("Main street, 120 to 130 m"));
    ASSERT_EQ(places.size(), 1U);
    EXPECT_EQ(places.front(), glm::dvec3(125.0, 1.0, 2.0));
    click(row("house-7"));
    ASSERT_EQ(places.size(), 2U);
    EXPECT_EQ(places.back(), glm::dvec3(100.0, 9.0, 4.0));
    click(row("p01"));
    ASSERT_EQ(probes.count(), 1);
    EXPECT_EQ(probes.front().front().toString(), "p01");
}

TEST_F(CoveragePanelTest, AProbeThatServesNextToNothingIsCalledThat) {
    panel.setFacts(someFacts());
    EXPECT_EQ(row("p01")->text(1), "21.0 %");
    EXPECT_EQ(row("p02")->text(1), "waste · 0.1 %");
    EXPECT_TRUE(row("p02")->toolTip(0).contains("next to nothing"));
}

TEST_F(CoveragePanelTest, WhatIsOpenStaysOpenWhenTheFiguresFollow) {
    panel.setFacts(someFacts());
    row("Main street")->setExpanded(false);
    CoverageFacts next = someFacts();
    next.coverage.mean = 0.9;
    panel.setFacts(next);
    EXPECT_FALSE(row("Main street")->isExpanded());
    row("Main street")->setExpanded(true);
    panel.setFacts(someFacts());
    EXPECT_TRUE(row("Main street")->isExpanded());
}

TEST_F(CoveragePanelTest, ASuggestionIsAskedForByCoverageOrByNumber) {
    const auto wish = panel.wish();
    EXPECT_EQ(wish.coverage, std::optional(0.95));
    EXPECT_FALSE(wish.count);
    test::child<QComboBox>(panel, "suggestKind")->setCurrentIndex(1);
    test::child<QSpinBox>(panel, "suggestCount")->setValue(27);
    SuggestionWish asked;
    QObject::connect(&panel, &CoveragePanel::suggestRequested,
                     [&](const SuggestionWish& w) { asked = w; });
    press("suggestProbes");
    EXPECT_EQ(asked.count, std::optional(27));
    EXPECT_FALSE(asked.coverage);
}

TEST_F(CoveragePanelTest, TheCardTakesAllOrNoneAndMoves) {
    auto* card = test::child<QFrame>(panel, "suggestionCard");
    EXPECT_FALSE(card->isVisible());
    panel.setSuggestion(SuggestionFacts{QStringLiteral("27 probes reach 96.1 %."),
                                        QStringLiteral("As many, evenly spaced: 80.0 %"),
                                        27,
                                        {{QStringLiteral("p03"), 0.021}}});
    EXPECT_TRUE(card->isVisible());
    const QSignalSpy all(&panel, &CoveragePanel::acceptAllRequested);
    const QSignalSpy none(&panel, &CoveragePanel::dismissRequested);
    const QSignalSpy moves(&panel, &CoveragePanel::moveRequested);
    EXPECT_EQ(test::child<QPushButton>(panel, "acceptSuggestions")->text(), "Accept all 27");
    press("acceptSuggestions");
    press("dismissSuggestions");
    EXPECT_EQ(test::child<QPushButton>(panel, "moveProbe_p03")->text(), "Move p03: +2.1 %");
    press("moveProbe_p03");
    EXPECT_EQ(all.count(), 1);
    EXPECT_EQ(none.count(), 1);
    ASSERT_EQ(moves.count(), 1);
    EXPECT_EQ(moves.front().front().toString(), "p03");
    panel.setSuggestion({});
    EXPECT_FALSE(card->isVisible());
}

TEST_F(CoveragePanelTest, TheButtonThatBeganSomethingStopsIt) {
    const QSignalSpy measured(&panel, &CoveragePanel::measureRequested);
    const QSignalSpy cancelled(&panel, &CoveragePanel::cancelRequested);
    press("measureCoverage");
    EXPECT_EQ(measured.count(), 1);
    panel.setMeasuring(true);
    press("measureCoverage");
    EXPECT_EQ(measured.count(), 1);
    EXPECT_EQ(cancelled.count(), 1);
    panel.setMeasuring(false);
    panel.setSuggesting(true);
    press("suggestProbes");
    EXPECT_EQ(cancelled.count(), 2);
}

/// A plan with a stretch of each kind and a suggested probe.
class CoveredPlanTest : public testing::Test {
protected:
    void SetUp() override {
        plan.setHeightfield(test::streetHeightfield());
        test::showWidget(plan, 720, 480);
        Box box;
        box.add({-60.0, -40.0, 0.0});
        box.add({60.0, 40.0, 0.0});
        plan.frameBox(box);
        CoverageOverlay overlay;
        overlay.bands = {{{{-40.0, 0.0, 0.0}, {-10.0, 0.0, 0.0}}, 0.9},
                         {{{10.0, 0.0, 0.0}, {40.0, 0.0, 0.0}}, 0.1}};
        overlay.ghosts = {{"s001", {0.0, 20.0, 1.75}, 1, 0.041}};
        plan.setCoverage(std::make_shared<const CoverageOverlay>(overlay));
    }
    /// Pixels of (about) a colour around a place of the plan.
    [[nodiscard]] int pixels(const QImage& image, const glm::dvec3& place, const QColor& color,
                             int reach) const {
        const QPoint middle = plan.toWidget(place).toPoint();
        int found = 0;
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                const QColor pixel = image.pixelColor(middle + QPoint(x, y));
                found += std::abs(pixel.red() - color.red()) < 12 &&
                                 std::abs(pixel.green() - color.green()) < 12 &&
                                 std::abs(pixel.blue() - color.blue()) < 12
                             ? 1
                             : 0;
            }
        return found;
    }

    PlanView plan;
};

TEST_F(CoveredPlanTest, StretchesHaveTheColourOfTheirCoverageAndPoorOnesAreHatched) {
    const QImage image = plan.grab().toImage();
    constexpr int kReach = 4;
    constexpr int kAll = (2 * kReach + 1) * (2 * kReach + 1);
    EXPECT_EQ(pixels(image, {-25.0, 0.0, 0.0}, coverageTone(0.9), kReach), kAll);
    const int dark = pixels(image, {25.0, 0.0, 0.0}, coverageTone(0.1), kReach);
    EXPECT_GT(dark, kAll / 4);
    EXPECT_LT(dark, kAll) << "stripes lie over it";
    EXPECT_TRUE(test::child<CoverageLegend>(plan, "coverageLegend")->isVisible());
    plan.setCoverage(nullptr);
    EXPECT_EQ(pixels(plan.grab().toImage(), {-25.0, 0.0, 0.0}, coverageTone(0.9), kReach), 0);
    EXPECT_FALSE(test::child<CoverageLegend>(plan, "coverageLegend")->isVisible());
}

TEST_F(CoveredPlanTest, AClickOnASuggestedProbeNamesItAndSelectsNothing) {
    const QSignalSpy ghosts(&plan.intents(), &EditIntents::ghostClicked);
    const QSignalSpy clicks(&plan.intents(), &EditIntents::clicked);
    QTest::mouseClick(&plan, Qt::LeftButton, {}, plan.toWidget({0.0, 20.0, 0.0}).toPoint());
    ASSERT_EQ(ghosts.count(), 1);
    EXPECT_EQ(ghosts.front().front().toString(), "s001");
    EXPECT_EQ(clicks.count(), 0);
    EXPECT_GT(pixels(plan.grab().toImage(), {0.0, 20.0, 0.0}, ghostTone(), 8), 8);
}

}  // namespace
}  // namespace reflet
