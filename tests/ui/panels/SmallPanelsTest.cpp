// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/panels/PanelTestSupport.h"
#include "widgets/common/DragSlider.h"
#include "widgets/panels/Checklist.h"
#include "widgets/panels/DayBand.h"
#include "widgets/panels/JobList.h"
#include "widgets/panels/MessageBar.h"
#include "widgets/panels/RemarkList.h"
#include "widgets/panels/ReportPanel.h"
#include "widgets/panels/SunPanel.h"
#include "widgets/panels/Timeline.h"

#include <QClipboard>
#include <QDateEdit>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>
#include <QToolButton>
#include <QTreeWidget>
#include <vector>

namespace reflet {
namespace {

GeoPosition delft() {
    return {4.36 * 3.14159265358979 / 180.0, 52.01 * 3.14159265358979 / 180.0, 0.0};
}

DateTime may15() {
    return {};
}

TEST(SunPanelTest, DraggingTheDayIsOneSequenceAndKeepsTheDate) {
    SunPanel panel;
    panel.setDate(may15());
    panel.setPlace(delft());
    test::showWidget(panel, 380, 320);
    std::vector<std::pair<DateTime, DragPhase>> changes;
    QObject::connect(&panel, &SunPanel::dateChanged, [&](const DateTime& date, DragPhase phase) {
        changes.emplace_back(date, phase);
    });
    auto* day = test::child<DragSlider>(panel, "daySlider");
    QTest::mousePress(day, Qt::LeftButton, {}, {day->width() / 2, 8});
    test::moveMouse(*day, {day->width() * 3 / 4, 8});
    QTest::mouseRelease(day, Qt::LeftButton, {}, {day->width() * 3 / 4, 8});
    ASSERT_GE(changes.size(), 3U);
    EXPECT_EQ(changes.front().second, DragPhase::Begin);
    EXPECT_EQ(changes.back().second, DragPhase::End);
    EXPECT_NEAR(changes.back().first.hour, 18, 1);
    EXPECT_EQ(changes.back().first.month, 5);
    EXPECT_EQ(changes.back().first.day, 15);
    EXPECT_EQ(changes.back().first.utcOffsetHours, 2.0);
}

TEST(SunPanelTest, TheYearSliderAndTheDateFieldChangeTheDay) {
    SunPanel panel;
    panel.setDate(may15());
    panel.setPlace(delft());
    test::showWidget(panel, 380, 320);
    DateTime last;
    QObject::connect(&panel, &SunPanel::dateChanged,
                     [&](const DateTime& date, DragPhase) { last = date; });
    auto* year = test::child<DragSlider>(panel, "yearSlider");
    year->setFocus();
    QTest::keyClick(year, Qt::Key_End);
    EXPECT_EQ(last.month, 12);
    EXPECT_EQ(last.day, 31);
    EXPECT_EQ(last.hour, 10);
    test::child<QDateEdit>(panel, "dateEdit")->setDate({2027, 2, 3});
    EXPECT_EQ(last.year, 2027);
    EXPECT_EQ(last.day, 3);
}

TEST(SunPanelTest, ExposureIsInStops) {
    SunPanel panel;
    test::showWidget(panel, 380, 320);
    panel.setExposure(1.0F);
    float last = 0.0F;
    QObject::connect(&panel, &SunPanel::exposureChanged,
                     [&](float exposure, DragPhase) { last = exposure; });
    auto* slider = test::child<DragSlider>(panel, "exposureSlider");
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_End);
    EXPECT_FLOAT_EQ(last, 64.0F);
}

TEST(DayBandTest, SunriseAndSunsetOfDelftInMayAreThoseOfTheAlmanac) {
    const Daylight day = daylightOf(may15(), delft());
    ASSERT_TRUE(day.sunrise && day.sunset);
    EXPECT_NEAR(*day.sunrise, 5 * 60 + 48, 4);
    EXPECT_NEAR(*day.sunset, 21 * 60 + 29, 4);
}

TEST(DayBandTest, TheSunDoesNotSetInTheNorthInJune) {
    DateTime date;
    date.month = 6;
    date.day = 21;
    const Daylight day = daylightOf(date, {0.4, 75.0 * 3.14159265 / 180.0, 0.0});
    EXPECT_FALSE(day.sunrise || day.sunset);
    EXPECT_GT(day.elevation[Daylight::kSamples / 2], 0.0);
}

TEST(TimelineTest, PlayScrubAndStart) {
    Timeline timeline;
    timeline.setDuration(40.0);
    test::showWidget(timeline, 500, 40);
    const QSignalSpy played(&timeline, &Timeline::playingChanged);
    std::vector<std::pair<double, DragPhase>> times;
    QObject::connect(&timeline, &Timeline::timeChanged,
                     [&](double seconds, DragPhase phase) { times.emplace_back(seconds, phase); });
    QTest::mouseClick(test::child<QToolButton>(timeline, "timelinePlay"), Qt::LeftButton);
    ASSERT_EQ(played.count(), 1);
    EXPECT_TRUE(played[0][0].toBool());
    auto* slider = test::child<DragSlider>(timeline, "timelineSlider");
    QTest::mousePress(slider, Qt::LeftButton, {}, {slider->width() / 2, 5});
    timeline.setTime(3.0);  // the clock goes on, but does not tear the handle away
    EXPECT_NEAR(timeline.time(), 20.0, 1.0);
    test::moveMouse(*slider, {slider->width() + 20, 5});
    QTest::mouseRelease(slider, Qt::LeftButton, {}, {slider->width() + 20, 5});
    EXPECT_NEAR(times.back().first, 40.0, 0.05);
    EXPECT_EQ(times.back().second, DragPhase::End);
    QTest::mouseClick(test::child<QToolButton>(timeline, "timelineStart"), Qt::LeftButton);
    EXPECT_EQ(times.back().first, 0.0);
}

TEST(ChecklistTest, TicksAppearAndStepsAreActivatedAndItCanBeLeft) {
    Checklist list;
    test::showWidget(list, 300, 400);
    const QSignalSpy steps(&list, &Checklist::stepActivated);
    const QSignalSpy left(&list, &Checklist::left);
    auto* second = test::child<QPushButton>(list, "step2");
    second->setFocus();
    QTest::keyClick(second, Qt::Key_Space);
    ASSERT_EQ(steps.count(), 1);
    EXPECT_EQ(steps[0][0].toInt(), int(Checklist::DrawRoute));
    list.setDone(Checklist::OpenCity, true);
    list.setDone(Checklist::SaveSomething, true);
    EXPECT_TRUE(test::child<QLabel>(list, "checklistTitle")->text().contains(QStringLiteral("2")));
    list.setPossible(Checklist::MakeItReflect, false);
    QTest::mouseClick(test::child<QPushButton>(list, "step3"), Qt::LeftButton);
    EXPECT_EQ(steps.count(), 1);
    QTest::mouseClick(test::child<QToolButton>(list, "checklistClose"), Qt::LeftButton);
    EXPECT_EQ(left.count(), 1);
}

TEST(JobListTest, CancelNamesItsJobAlsoAfterOthersHaveEnded) {
    JobList list;
    test::showWidget(list, 320, 300);
    list.setJobs({{1, "Baking", "probe 3 of 9", 0.3, false}, {2, "Measuring", "", -1.0, false}});
    list.setJobs({{2, "Measuring", "reference", 0.5, false}});
    QTest::qWait(10);
    const QSignalSpy cancelled(&list, &JobList::cancelRequested);
    QToolButton* button = nullptr;
    for (auto* each : list.findChildren<QToolButton*>())
        if (each->isVisible())
            button = each;
    ASSERT_NE(button, nullptr);
    QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_EQ(cancelled.count(), 1);
    EXPECT_EQ(cancelled[0][0].toULongLong(), 2U);
    list.setJobs({{2, "Measuring", "reference", 0.5, true}});
    EXPECT_FALSE(button->isEnabled()) << "once is enough";
}

TEST(MessageBarTest, MessagesWaitInLineAndEscapeClosesTheFrontOne) {
    QWidget window;
    MessageBar bar(&window);
    test::showWidget(window, 700, 200);
    bar.resize(700, 120);
    Error error;
    error.what = "the file is not there";
    error.subject = "street.city.json";
    error.remedy = "choose where it is now";
    const quint64 first = bar.post(error);
    EXPECT_EQ(bar.post(error), first) << "the same is not said twice";
    Message second;
    second.what = QStringLiteral("A second matter");
    bar.post(second);
    EXPECT_EQ(bar.count(), 2);
    const QString text = test::child<QLabel>(bar, "messageText")->text();
    EXPECT_TRUE(text.contains(QStringLiteral("The file is not there.")));
    EXPECT_TRUE(text.contains(QStringLiteral("street.city.json")));
    EXPECT_TRUE(text.contains(QStringLiteral("Choose where it is now.")));
    const QSignalSpy dismissed(&bar, &MessageBar::dismissed);
    bar.setFocus();
    QTest::keyClick(&bar, Qt::Key_Escape);
    ASSERT_EQ(dismissed.count(), 1);
    EXPECT_EQ(dismissed[0][0].toULongLong(), first);
    EXPECT_TRUE(bar.isVisible());
    QTest::keyClick(&bar, Qt::Key_Escape);
    EXPECT_FALSE(bar.isVisible());
}

TEST(MessageBarTest, WhatWentWrongIsSaidBeforeWhatWentWell) {
    QWidget window;
    MessageBar bar(&window);
    test::showWidget(window, 700, 200);
    const auto post = [&bar](Severity severity, const char* what) {
        Message message;
        message.severity = severity;
        message.what = QString::fromLatin1(what);
        bar.post(message);
    };
    post(Severity::Info, "The city is here.");
    post(Severity::Warning, "The buildings hang in the air.");
    post(Severity::Warning, "A picture is missing.");
    QStringList said;
    while (bar.count() > 0) {
        said << test::child<QLabel>(bar, "messageText")->text();
        bar.setFocus();
        QTest::keyClick(&bar, Qt::Key_Escape);
    }
    ASSERT_EQ(said.size(), 3);
    EXPECT_TRUE(said[0].contains(QStringLiteral("hang in the air")));
    EXPECT_TRUE(said[1].contains(QStringLiteral("picture is missing")));
    EXPECT_TRUE(said[2].contains(QStringLiteral("city is here")));
}

TEST(MessageBarTest, AnActionIsReportedAndClosesItsMessage) {
    QWidget window;
    MessageBar bar(&window);
    test::showWidget(window, 700, 200);
    Message message;
    message.what = QStringLiteral("Two <b>models</b> have changed");
    message.actions = QStringList{QStringLiteral("Import again"), QStringLiteral("Keep")};
    bar.post(message);
    EXPECT_TRUE(
        test::child<QLabel>(bar, "messageText")->text().contains(QStringLiteral("&lt;b&gt;models")))
        << "text of files is never markup";
    const QSignalSpy acted(&bar, &MessageBar::actionTriggered);
    for (auto* button : bar.findChildren<QPushButton*>())
        if (button->text() == QStringLiteral("Keep"))
            QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_EQ(acted.count(), 1);
    EXPECT_EQ(acted[0][1].toInt(), 1);
    EXPECT_EQ(bar.count(), 0);
}

TEST(RemarkListTest, AreSortedBySeverityCodeAndObject) {
    RemarkList list;
    test::showWidget(list, 800, 300);
    list.setRemarks({{"a", {Severity::Warning, "c-second", "b", "", ""}},
                     {"a", {Severity::Error, "a-third", "c", "", ""}},
                     {"a", {Severity::Info, "b-first", "a", "", ""}}});
    auto* table = list.findChild<QTableView*>();
    const auto objects = [&](const QString& title, Qt::SortOrder order) {
        QAbstractItemModel* model = table->model();
        for (int column = 0; column < model->columnCount(); ++column)
            if (model->headerData(column, Qt::Horizontal).toString() == title)
                table->sortByColumn(column, order);
        QString text;
        for (int row = 0; row < model->rowCount(); ++row)
            text += model->index(row, 1).data().toString();
        return text;
    };
    EXPECT_EQ(objects(QStringLiteral("Kind"), Qt::DescendingOrder), QStringLiteral("cba"));
    EXPECT_EQ(objects(QStringLiteral("Code"), Qt::AscendingOrder), QStringLiteral("cab"));
    EXPECT_EQ(objects(QStringLiteral("Object"), Qt::AscendingOrder), QStringLiteral("abc"));
}

TEST(ReportPanelTest, TellsOfFilesAndRemarksAndOffersToSaveWhenThereIsSomething) {
    ReportPanel panel;
    test::showWidget(panel, 700, 400);
    auto* save = test::child<QPushButton>(panel, "reportSave");
    EXPECT_FALSE(save->isEnabled());
    panel.setReport(QStringLiteral("Objects: 3."),
                    {{"a.json", {Severity::Warning, "hole", "house-1", "A hole", ""}}},
                    {{"a.json", {{"Coordinates", "EPSG:28992, as the file says"}}}});
    EXPECT_EQ(panel.remarks()->shownCount(), 1);
    auto* files = test::child<QTreeWidget>(panel, "reportFiles");
    ASSERT_EQ(files->topLevelItemCount(), 1);
    EXPECT_EQ(files->topLevelItem(0)->child(0)->text(1),
              QStringLiteral("EPSG:28992, as the file says"));
    const QSignalSpy saved(&panel, &ReportPanel::saveRequested);
    QTest::mouseClick(save, Qt::LeftButton);
    EXPECT_EQ(saved.count(), 1);
}

TEST(RemarkListTest, RemarksAreFilteredCopiedAndFollowed) {
    RemarkList list;
    test::showWidget(list, 800, 300);
    const FileRemark closed{"a.json",
                            {Severity::Warning, "hole", "house-1", "A hole was closed", ""}};
    FileRemark left{"a.json", {Severity::Error, "skip", "house-2", "Left out", "Repair it"}};
    left.type = QStringLiteral("Bridge");
    left.lod = QStringLiteral("2");
    left.result = QStringLiteral("left out");
    const FileRemark noted{"b.json", {Severity::Info, "note", "", "No CRS", ""}};
    list.setRemarks({closed, left, noted});
    EXPECT_EQ(list.shownCount(), 3);
    QTest::keyClicks(test::child<QLineEdit>(list, "remarkFilter"), QStringLiteral("HOUSE"));
    EXPECT_EQ(list.shownCount(), 2);
    QTest::mouseClick(test::child<QToolButton>(list, "remarkCopy"), Qt::LeftButton);
    const QString copied = QApplication::clipboard()->text();
    EXPECT_EQ(copied.count(QLatin1Char('\n')), 1);
    EXPECT_TRUE(
        copied.startsWith(QStringLiteral("Error\thouse-2\tBridge\t2\tleft out\tskip\tLeft out")))
        << copied.toStdString();
    const QSignalSpy followed(&list, &RemarkList::objectActivated);
    auto* table = list.findChild<QTableView*>();
    table->setCurrentIndex(table->model()->index(1, 0));
    table->setFocus();
    QTest::keyClick(table, Qt::Key_Return);
    ASSERT_EQ(followed.count(), 1);
    EXPECT_EQ(followed[0][1].toString(), QStringLiteral("house-1"));
    auto* whole = test::child<QLabel>(list, "remarkWhole");
    EXPECT_EQ(whole->text(), QStringLiteral("A hole was closed"));
    table->setCurrentIndex(table->model()->index(0, 0));
    EXPECT_EQ(whole->text(), QStringLiteral("Left out\nRepair it"));
}

}  // namespace
}  // namespace reflet
