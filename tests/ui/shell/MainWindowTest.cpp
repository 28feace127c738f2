// SPDX-License-Identifier: GPL-3.0-or-later
// The real window, on a real (virtual) screen.
#include "app/shell/Commands.h"
#include "app/shell/MainWindow.h"
#include "app/shell/StartOptions.h"
#include "app/shell/files/DroppedFiles.h"
#include "app/shell/files/FileController.h"
#include "app/shell/overlays/Stage.h"
#include "app/shell/overlays/Welcome.h"
#include "core/project/ProjectFile.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/ui/Patience.h"
#include "widgets/panels/MessageBar.h"
#include "widgets/plan/PlanView.h"

#include <gtest/gtest.h>

#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QTest>
#include <QToolBar>
#include <QUrl>
#include <set>

namespace {

using namespace reflet;

QAction* action(const MainWindow& window, Command command) {
    return window.bench().commands->action(command);
}

MessageBar* messages(const MainWindow& window) {
    return window.findChild<MessageBar*>(QStringLiteral("messageBar"));
}

void drop(MainWindow& window, const QString& path) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter(QPoint(100, 100), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &enter);
    ASSERT_TRUE(enter.isAccepted());
    QDropEvent event(QPointF(100, 100), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &event);
}

class MainWindowTest : public testing::Test {
protected:
    void SetUp() override {
        window.show();
        ASSERT_TRUE(QTest::qWaitForWindowActive(&window, test::kPatience));
    }
    MainWindow window;
};

TEST_F(MainWindowTest, ShowsThePictureAndTheStepsAndKeepsTheRestAway) {
    EXPECT_TRUE(window.bench().stage->isVisible());
    EXPECT_FALSE(window.bench().plan->isVisible());
    EXPECT_TRUE(window.findChild<QDockWidget*>(QStringLiteral("checklistDock"))->isVisible());
    EXPECT_FALSE(window.findChild<QDockWidget*>(QStringLiteral("tuningDock"))->isVisible());
}

TEST_F(MainWindowTest, EveryCommandHasATextAnExplanationAndAPlaceInAMenu) {
    QSet<QAction*> inMenus;
    for (QMenu* menu : window.findChildren<QMenu*>()) {
        for (QAction* entry : menu->actions()) {
            inMenus.insert(entry);
        }
    }
    for (const CommandInfo& info : allCommands()) {
        QAction* entry = action(window, info.command);
        EXPECT_FALSE(entry->text().isEmpty()) << info.name;
        EXPECT_FALSE(entry->toolTip().isEmpty()) << info.name;
        EXPECT_TRUE(inMenus.contains(entry)) << info.name;
    }
}

TEST(Commands, NoTwoHaveTheSameKey) {
    std::set<std::string> keys;
    for (const CommandInfo& info : allCommands()) {
        if (*info.keys != '\0') {
            EXPECT_TRUE(keys.insert(info.keys).second) << info.keys;
        }
    }
    EXPECT_GT(keys.size(), 20U);
}

TEST(Commands, EveryIconThatIsNamedExists) {
    QWidget window;
    const Commands commands(&window);
    for (const CommandInfo& info : allCommands()) {
        if (*info.icon != '\0') {
            EXPECT_FALSE(commands.action(info.command)->icon().isNull()) << info.icon;
        }
    }
}

TEST_F(MainWindowTest, ThePlanStandsBesideThePictureAfterOneClick) {
    action(window, Command::PlanBeside)->trigger();
    EXPECT_TRUE(window.bench().plan->isVisible());
    action(window, Command::ResetLayout)->trigger();
    EXPECT_FALSE(window.bench().plan->isVisible());
}

TEST_F(MainWindowTest, AQuestionMarkShowsAllKeysAndEscapeTakesThemAway) {
    QTest::keyClick(&window, Qt::Key_Question, Qt::ShiftModifier);
    auto* keys = window.findChild<QWidget*>(QStringLiteral("keysOverlay"));
    if (!keys) {
        action(window, Command::Keys)->trigger();
        keys = window.findChild<QWidget*>(QStringLiteral("keysOverlay"));
    }
    ASSERT_NE(keys, nullptr);
    QTest::keyClick(keys, Qt::Key_Escape);
    EXPECT_FALSE(keys->isVisible());
}

TEST_F(MainWindowTest, AFileOfAnUnknownKindIsAnsweredWithWhatRefletKnows) {
    drop(window, QStringLiteral("/nowhere/notes.docx"));
    EXPECT_EQ(messages(window)->count(), 1);
    EXPECT_TRUE(window.document().project().models.empty());
}

TEST_F(MainWindowTest, ABrokenProjectLeavesTheDocumentAsItWas) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "broken.reflet";
    QFile file(QString::fromStdString(path.string()));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("{ \"schema\": 99");
    file.close();
    Project project;
    project.name = "before";
    window.document().adopt(project);
    drop(window, file.fileName());
    EXPECT_EQ(messages(window)->count(), 1);
    EXPECT_EQ(window.document().project().name, "before");
}

TEST_F(MainWindowTest, ClosingWithUnsavedChangesAsksAndCancelKeepsTheWindow) {
    Project project;
    project.name = "mine";
    window.document().adopt(project, {}, ProjectDocument::Condition::Dirty);
    window.close();
    EXPECT_TRUE(window.isVisible());
    auto* question = window.findChild<QMessageBox*>(QStringLiteral("unsavedQuestion"));
    ASSERT_NE(question, nullptr);
    question->button(QMessageBox::Cancel)->click();
    EXPECT_TRUE(window.isVisible());
    window.close();
    for (auto* open : window.findChildren<QMessageBox*>(QStringLiteral("unsavedQuestion"))) {
        if (open->isVisible()) {
            open->button(QMessageBox::Discard)->click();
        }
    }
    EXPECT_FALSE(window.isVisible());
}

TEST_F(MainWindowTest, TheProjectThatWasSavedLastIsInTheListOfRecentOnes) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "town.reflet";
    ASSERT_TRUE(saveProject(Project{}, path));
    drop(window, QString::fromStdString(path.string()));
    EXPECT_EQ(window.document().file(), path);
    auto* recent = window.findChild<QMenu*>(QStringLiteral("recentMenu"));
    ASSERT_FALSE(recent->isEmpty());
    EXPECT_EQ(recent->actions().front()->text(), QStringLiteral("town"));
}

TEST_F(MainWindowTest, TheToolBarGivesUpItsWordsBeforeAnyOfItsButtons) {
    auto* bar = window.findChild<QToolBar*>(QStringLiteral("toolBar"));
    ASSERT_NE(bar, nullptr);
    const auto allShown = [&] {
        for (QAction* entry : bar->actions()) {
            if (!entry->isSeparator() && !bar->widgetForAction(entry)->isVisible()) {
                return false;
            }
        }
        return true;
    };
    window.resize(1440, 700);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return bar->toolButtonStyle() == Qt::ToolButtonTextUnderIcon && allShown(); },
        test::kPatience));
    window.resize(800, 600);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return bar->toolButtonStyle() == Qt::ToolButtonIconOnly && allShown(); },
        test::kPatience));
    window.resize(1440, 700);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return bar->toolButtonStyle() == Qt::ToolButtonTextUnderIcon; }, test::kPatience));
}

TEST_F(MainWindowTest, WhoeverChecksTheReferenceHasLeftTheWelcome) {
    const test::TemporaryFolder folder;
    StartOptions options;
    options.samples = QString::fromStdString(folder.path().string());
    window.start(options);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return window.bench().stage->welcome()->isVisible(); }, 60'000));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return action(window, Command::CheckReference)->isEnabled(); }, 60'000));
    // Also when the city is not there yet: then there is nothing to check, and it is said.
    action(window, Command::CheckReference)->trigger();
    EXPECT_FALSE(window.bench().stage->welcome()->isVisible());
    window.jobs().cancelAll();
}

TEST(StartOptions, NamesFilesAbsolutelyAndRefusesWhatIsNoNumber) {
    const auto parsed = parseStart({"reflet", "a.reflet", "--screenshot", "o.png", "--after", "2"});
    ASSERT_TRUE(parsed);
    EXPECT_TRUE(parsed->options.files.front().startsWith(QLatin1Char('/')));
    EXPECT_DOUBLE_EQ(parsed->options.screenshotAfter, 2.0);
    EXPECT_FALSE(parsed->options.screenshotAtFirstPicture);
    EXPECT_FALSE(parseStart({"reflet", "--after", "soon"}));
    const auto rehearsal = parseStart({"reflet", "--rehearse"});
    ASSERT_TRUE(rehearsal.has_value());
    EXPECT_TRUE(rehearsal->options.rehearse);
    const auto first = parseStart({"reflet", "--say-times", "--after", "first-picture"});
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->options.screenshotAtFirstPicture);
    EXPECT_TRUE(first->options.sayTimes);
    EXPECT_FALSE(parseStart({"reflet", "--wrong"}));
    EXPECT_TRUE(parseStart({"reflet", "--version"})->text.has_value());
}

TEST(StartOptions, KnowTheProjectThatIsShownFirst) {
    const test::TemporaryFolder folder;
    const QString root = QString::fromStdString(folder.path().string());
    StartOptions options;
    options.samples = root;
    EXPECT_EQ(firstProject(options), QString()) << "the sample is still to be written";
    const QString sample = root + QStringLiteral("/square.reflet");
    const QString own = root + QStringLiteral("/own.reflet");
    for (const QString& path : {sample, own}) {
        QFile file(path);
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    }
    EXPECT_EQ(firstProject(options), sample);
    options.files = QStringList{root + QStringLiteral("/city.json"), own};
    EXPECT_EQ(firstProject(options), own);
    options.files = QStringList{root + QStringLiteral("/city.json")};
    EXPECT_EQ(firstProject(options), QString()) << "a city has no project yet";
}

TEST(DroppedFiles, AFolderIsItsProjectOrElseItsCities) {
    const test::TemporaryFolder folder;
    const QString root = QString::fromStdString(folder.path().string());
    for (const char* name : {"a.city.json", "b.city.json"}) {
        QFile file(root + QLatin1Char('/') + QLatin1String(name));
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    }
    EXPECT_EQ(sortDropped({root}).cities.size(), 2);
    QFile project(root + QStringLiteral("/p.reflet"));
    ASSERT_TRUE(project.open(QIODevice::WriteOnly));
    EXPECT_EQ(sortDropped({root}).projects.size(), 1);
    EXPECT_TRUE(sortDropped({root}).cities.isEmpty());
    EXPECT_EQ(sortDropped({QStringLiteral("/x/tram.GLB")}).vehicles.size(), 1);
}

}  // namespace
