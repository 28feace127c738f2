// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/panels/PanelTestSupport.h"
#include "widgets/common/DragSlider.h"
#include "widgets/common/NumberEdit.h"
#include "widgets/tuning/Presets.h"
#include "widgets/tuning/TuningPanel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QSignalSpy>
#include <QStyle>
#include <QTableWidget>
#include <QToolButton>
#include <vector>

namespace reflet {
namespace {

class TuningPanelTest : public testing::Test {
protected:
    void SetUp() override {
        test::showWidget(panel, 380, 900);
        QObject::connect(&panel, &TuningPanel::tuningChanged,
                         [this](const MemSettings& tuning, DragPhase phase) {
                             changes.emplace_back(tuning, phase);
                         });
        QObject::connect(&panel, &TuningPanel::methodsChanged,
                         [this](Method left, std::optional<Method> right) {
                             methods.emplace_back(left, right);
                         });
    }
    TuningPanel panel;
    std::vector<std::pair<MemSettings, DragPhase>> changes;
    std::vector<std::pair<Method, std::optional<Method>>> methods;
};

TEST_F(TuningPanelTest, DetailReachesInfinityAndZeroWithTheMouseInOneSequence) {
    auto* slider = test::child<DragSlider>(panel, "detailSlider");
    const int middle = slider->height() / 2;
    QTest::mousePress(slider, Qt::LeftButton, {}, {slider->width() / 2, middle});
    test::moveMouse(*slider, {20, middle});
    test::moveMouse(*slider, {-30, middle});
    ASSERT_FALSE(changes.empty());
    EXPECT_TRUE(std::isinf(changes.back().first.depthRatio));
    test::moveMouse(*slider, {slider->width() - 10, middle});
    test::moveMouse(*slider, {slider->width() + 30, middle});
    QTest::mouseRelease(slider, Qt::LeftButton, {}, {slider->width() + 30, middle});
    EXPECT_EQ(changes.back().first.depthRatio, 0.0);
    EXPECT_EQ(changes.front().second, DragPhase::Begin);
    EXPECT_EQ(changes.back().second, DragPhase::End);
    for (std::size_t i = 1; i + 1 < changes.size(); ++i)
        EXPECT_EQ(changes[i].second, DragPhase::Move);
}

TEST_F(TuningPanelTest, DetailReachesBothEndsWithKeys) {
    auto* slider = test::child<DragSlider>(panel, "detailSlider");
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_Home);
    EXPECT_TRUE(std::isinf(changes.back().first.depthRatio));
    EXPECT_EQ(test::child<QLineEdit>(panel, "detailRatio")->text(), QStringLiteral("∞"));
    QTest::keyClick(slider, Qt::Key_End);
    EXPECT_EQ(changes.back().first.depthRatio, 0.0);
    EXPECT_EQ(changes.back().second, DragPhase::End);
}

TEST_F(TuningPanelTest, EscapeTakesASlidersDragBack) {
    auto* slider = test::child<DragSlider>(panel, "detailSlider");
    QTest::mousePress(slider, Qt::LeftButton, {}, {slider->width() / 4, 5});
    test::moveMouse(*slider, {slider->width() / 3, 5});
    QTest::keyClick(slider, Qt::Key_Escape);
    ASSERT_GE(changes.size(), 2U);
    EXPECT_EQ(changes.back().second, DragPhase::Cancel);
    EXPECT_NEAR(changes.back().first.depthRatio, MemSettings{}.depthRatio, 0.01);
    const std::size_t before = changes.size();
    QTest::mouseRelease(slider, Qt::LeftButton, {}, {slider->width() / 2, 5});
    EXPECT_EQ(changes.size(), before);
}

TEST_F(TuningPanelTest, RIsTypedAsANumberOrInfinity) {
    auto* ratio = test::child<QLineEdit>(panel, "detailRatio");
    const auto type = [&](const QString& text) {
        ratio->setFocus();
        ratio->selectAll();
        QTest::keyClicks(ratio, text);
        QTest::keyClick(ratio, Qt::Key_Return);
    };
    type(QStringLiteral("0.35"));
    EXPECT_DOUBLE_EQ(changes.back().first.depthRatio, 0.35);
    type(QStringLiteral("inf"));
    EXPECT_TRUE(std::isinf(changes.back().first.depthRatio));
    const std::size_t before = changes.size();
    type(QStringLiteral("-3"));
    type(QStringLiteral("nonsense"));
    EXPECT_EQ(changes.size(), before);
    EXPECT_EQ(ratio->text(), QStringLiteral("∞"));
}

TEST_F(TuningPanelTest, QualityGoesFromFastToExact) {
    auto* slider = test::child<DragSlider>(panel, "qualitySlider");
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_End);
    EXPECT_EQ(changes.back().first.depthRatio, 0.0);
    QTest::keyClick(slider, Qt::Key_Home);
    EXPECT_LT(changes.back().first.resolution, MemSettings{}.resolution);
    EXPECT_EQ(presetOf(MemSettings{}), std::optional(kPresets / 2)) << "the default is a preset";
}

TEST_F(TuningPanelTest, AnExpertsSettingGoesBackToAutomatic) {
    QTest::mouseClick(test::child<QToolButton>(panel, "expertButton"), Qt::LeftButton);
    auto* interpolation = test::child<QComboBox>(panel, "expertInterpolation");
    ASSERT_TRUE(interpolation->isVisible());
    interpolation->setFocus();
    QTest::keyClick(interpolation, Qt::Key_Down);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].first.interpolation, Interpolation::AsInPaper);
    QToolButton* automatic = nullptr;
    for (auto* button : panel.findChildren<QToolButton*>())
        if (button->text() == QStringLiteral("Automatic") && button->isEnabled())
            automatic = button;
    ASSERT_NE(automatic, nullptr) << "only what is not automatic can go back";
    QTest::mouseClick(automatic, Qt::LeftButton);
    EXPECT_EQ(changes.back().first, MemSettings{});
    EXPECT_FALSE(automatic->isEnabled());
}

TEST_F(TuningPanelTest, TheLevelOfDetailIsTurnedAndItsSmoothnessAndBlurAreTyped) {
    auto* on = test::child<QCheckBox>(panel, "lodOn");
    EXPECT_TRUE(on->isChecked());
    QTest::mouseClick(on, Qt::LeftButton, {}, {8, on->height() / 2});
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_FALSE(changes[0].first.lod.on);
    const auto type = [&](const char* name, const QString& text) {
        auto* edit = test::child<NumberEdit>(panel, name);
        edit->setFocus();
        edit->selectAll();
        QTest::keyClicks(edit, text);
        QTest::keyClick(edit, Qt::Key_Return);
    };
    EXPECT_EQ(test::child<NumberEdit>(panel, "lodPace")->value(), 30.0) << "33 ms";
    type("lodPace", QStringLiteral("20"));
    EXPECT_DOUBLE_EQ(changes.back().first.lod.frameBudget, 50.0);
    EXPECT_EQ(changes.back().second, DragPhase::End);
    type("lodBlur", QStringLiteral("50"));
    EXPECT_DOUBLE_EQ(changes.back().first.lod.blur, 0.5);
    EXPECT_DOUBLE_EQ(changes.back().first.lod.frameBudget, 50.0) << "the others stay";
    MemSettings rest = changes.back().first;
    rest.lod = {};
    EXPECT_EQ(rest, MemSettings{}) << "nothing else changes, and it stays a preset";
    MemSettings shown;
    shown.lod = {true, 12.5, 0.25};
    const std::size_t before = changes.size();
    panel.setTuning(shown);
    EXPECT_EQ(test::child<NumberEdit>(panel, "lodPace")->value(), 80.0);
    EXPECT_EQ(test::child<NumberEdit>(panel, "lodBlur")->value(), 25.0);
    EXPECT_TRUE(on->isChecked());
    EXPECT_EQ(changes.size(), before) << "what is shown is not reported";
}

TEST_F(TuningPanelTest, TellsHowManyReflectionsAreMadeHow) {
    auto* counts = test::child<QLabel>(panel, "lodCounts");
    FrameStatistics frame;
    frame.lod.on = true;
    frame.lod.full = 3;
    frame.lod.reduced = 8;
    frame.lod.hidden = 21;
    frame.lod.coarse = 2;
    panel.setFrame(frame, 30.0);
    const QString text = counts->text().replace(QChar(QChar::Nbsp), QLatin1Char(' '));
    for (const char* part : {"3 full", "8 reduced", "21 hidden", "2 of 10"})
        EXPECT_TRUE(text.contains(QLatin1String(part))) << text.toStdString();
    EXPECT_FALSE(counts->text().contains(QStringLiteral("blended"))) << "none is";
}

TEST_F(TuningPanelTest, MethodsOfBothSidesAreChosen) {
    auto* right = test::child<QComboBox>(panel, "methodRight");
    right->setFocus();
    QTest::keyClick(right, Qt::Key_End);
    ASSERT_EQ(methods.size(), 1U);
    EXPECT_EQ(methods[0].first, Method::Mem);
    EXPECT_EQ(methods[0].second, std::optional(allMethods().back()));
    QTest::keyClick(right, Qt::Key_Home);
    EXPECT_FALSE(methods.back().second.has_value());
}

TEST_F(TuningPanelTest, CheckAgainstTheReferenceAsksOnce) {
    const QSignalSpy asked(&panel, &TuningPanel::measureRequested);
    auto* button = test::child<QPushButton>(panel, "measure");
    QTest::mouseClick(button, Qt::LeftButton);
    panel.setMeasuring(true);
    QTest::mouseClick(button, Qt::LeftButton);
    EXPECT_EQ(asked.count(), 1);
}

TEST(PresetsTest, EachPositionOfTheDetailSliderIsFoundAgain) {
    for (int position = 0; position <= kDetailSteps; ++position) {
        const double ratio = depthRatioAt(position);
        EXPECT_EQ(depthRatioAt(positionOf(ratio)), ratio) << position;
        if (position > 0) {
            EXPECT_LE(ratio, depthRatioAt(position - 1));
        }
    }
}

TEST_F(TuningPanelTest, TheFiguresTellHowMuchChangeIsSeenAndWhichSurfacesAreWrong) {
    MethodRow mem{Method::Mem, 31.2, 0.95, 7.8, 14788, 19581, 0.01};
    mem.flip = 0.0426;
    mem.wrongSurface = 0.0113;
    MethodRow reference;
    reference.method = Method::RayTrace;
    panel.setFigures({mem, reference}, QStringLiteral("car 1, 12.4 m along its route"));
    auto* table = test::child<QTableWidget>(panel, "figures");
    ASSERT_EQ(table->rowCount(), 2);
    const auto columnOf = [&](const QString& name) {
        int column = 0;
        while (column < table->columnCount() && table->horizontalHeaderItem(column)->text() != name)
            ++column;
        return column;
    };
    const int flip = columnOf(QStringLiteral("FLIP"));
    const int wrong = columnOf(QStringLiteral("Wrong surface"));
    ASSERT_LT(flip, table->columnCount());
    ASSERT_LT(wrong, table->columnCount());
    EXPECT_FALSE(table->horizontalHeaderItem(flip)->toolTip().isEmpty());
    const QLocale locale;
    EXPECT_EQ(table->item(0, flip)->text(), locale.toString(0.043, 'f', 3));
    EXPECT_EQ(table->item(0, wrong)->text(),
              QStringLiteral("%1 %").arg(locale.toString(1.1, 'f', 1)));
    // The reference against itself, and without probes in use.
    EXPECT_EQ(table->item(1, flip)->text(), QStringLiteral("–"));
    EXPECT_EQ(table->item(1, wrong)->text(), QStringLiteral("–"));
    panel.setFiguresStale(true);
    EXPECT_FALSE(table->isEnabled());
}

}  // namespace
}  // namespace reflet
