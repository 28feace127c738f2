// SPDX-License-Identifier: GPL-3.0-or-later
// What panels and views ask for reaches the document and the views.
#include "app/document/LiveCity.h"
#include "app/document/Recovery.h"
#include "app/document/files/DerivedFiles.h"
#include "app/pipeline/LoadedCity.h"
#include "app/shell/Commands.h"
#include "app/shell/MainWindow.h"
#include "app/shell/overlays/Stage.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/ui/Patience.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/panels/MessageBar.h"
#include "widgets/panels/Timeline.h"
#include "widgets/plan/PlanView.h"
#include "widgets/viewport/Viewport.h"

#include <gtest/gtest.h>

#include <QDialogButtonBox>
#include <QDragEnterEvent>
#include <QDragLeaveEvent>
#include <QFileDialog>
#include <QInputDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QTest>
#include <QToolButton>
#include <QUrl>
#include <fstream>

namespace {

using namespace reflet;

class WiringTest : public testing::Test {
protected:
    void SetUp() override {
        window.show();
        ASSERT_TRUE(QTest::qWaitForWindowActive(&window, test::kPatience));
        Project project;
        project.name = "wires";
        for (const char* id : {"p1", "p2"}) {
            project.probes.push_back({id, {0.0, 0.0, 2.0}, {}, false});
        }
        window.document().adopt(project);
    }
    const Project& project() { return window.document().project(); }
    MessageBar* messages() { return window.findChild<MessageBar*>(QStringLiteral("messageBar")); }
    MainWindow window;
};

TEST_F(WiringTest, WhatIsChangedOnSeveralItemsAtOnceIsOneStepOfUndo) {
    std::vector<Probe> probes = project().probes;
    for (Probe& probe : probes) {
        probe.resolution = 64;
    }
    Q_EMIT window.bench().inspector->probesChanged(probes, DragPhase::End);
    EXPECT_EQ(project().probes[0].resolution, 64);
    EXPECT_EQ(project().probes[1].resolution, 64);
    EXPECT_EQ(window.document().undoStack()->count(), 1);
    window.bench().commands->action(Command::Undo)->trigger();
    EXPECT_FALSE(project().probes[0].resolution);
    EXPECT_FALSE(project().probes[1].resolution);
}

TEST_F(WiringTest, ADragOfSeveralItemsIsOneStepAndNoOpenMacroStandsInTheWayOfOthers) {
    const auto locked = [&](double height) {
        std::vector<Probe> probes = project().probes;
        for (Probe& probe : probes) {
            probe.position.z = height;
        }
        return probes;
    };
    Inspector* inspector = window.bench().inspector;
    QUndoStack* stack = window.document().undoStack();
    Q_EMIT inspector->probesChanged(locked(3.0), DragPhase::Begin);
    Q_EMIT inspector->probesChanged(locked(4.0), DragPhase::Move);
    EXPECT_EQ(stack->count(), 1);
    EXPECT_TRUE(stack->canUndo()) << "a macro that is open could not be undone";
    Q_EMIT inspector->probesChanged(locked(5.0), DragPhase::End);
    EXPECT_EQ(stack->count(), 1);
    EXPECT_EQ(project().probes[1].position.z, 5.0);
    stack->undo();
    EXPECT_EQ(project().probes[0].position.z, 2.0);
    EXPECT_EQ(project().probes[1].position.z, 2.0);

    Q_EMIT inspector->probesChanged(locked(3.0), DragPhase::Begin);
    Q_EMIT inspector->probesChanged(locked(4.0), DragPhase::Move);
    Q_EMIT inspector->probesChanged({}, DragPhase::Cancel);
    EXPECT_EQ(project().probes[0].position.z, 2.0);
    EXPECT_FALSE(stack->canUndo());
}

/// From the menu below *Add vehicle*.
TEST_F(WiringTest, APersonWalksTheRouteThatIsThereAndOneUndoTakesThemAway) {
    auto* button = window.findChild<QToolButton*>(QStringLiteral("tool_addTram"));
    ASSERT_NE(button, nullptr);
    ASSERT_NE(button->menu(), nullptr);
    QAction* add = nullptr;
    for (QAction* action : button->menu()->actions()) {
        if (action->text() == QStringLiteral("Add &person"))
            add = action;
    }
    ASSERT_NE(add, nullptr);
    add->trigger();
    EXPECT_TRUE(project().reflectors.empty()) << "there is no route yet";
    EXPECT_EQ(messages()->count(), 1);

    const std::string route = window.document().addRoute({{0.0, 0.0, 0.0}, {50.0, 0.0, 0.0}});
    add->trigger();
    ASSERT_EQ(project().reflectors.size(), 1U);
    const Reflector& person = project().reflectors[0];
    EXPECT_EQ(person.vehicle, "woman");
    EXPECT_EQ(person.route, route);
    EXPECT_LT(person.speed, 3.0) << "on foot, metres a second";
    EXPECT_TRUE(window.document().selection()->contains({ProjectItem::Kind::Reflector, person.id}));
    window.bench().commands->action(Command::Undo)->trigger();
    EXPECT_TRUE(project().reflectors.empty());
    EXPECT_EQ(project().routes.size(), 1U);
}

TEST_F(WiringTest, AViewThatWasKeptIsGoneToFromTheMenuAndReplacedUnderItsName) {
    const Camera there{{10.0, 20.0, 30.0}, {40.0, 20.0, 2.0}, 0.9};
    const auto keep = [&](const QString& name) {
        window.bench().commands->action(Command::SaveView)->trigger();
        QInputDialog* dialog = nullptr;
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                dialog = window.findChild<QInputDialog*>(QStringLiteral("viewNameDialog"));
                return dialog && dialog->isVisible();
            },
            test::kPatience));
        auto* edit = dialog->findChild<QLineEdit*>();
        edit->selectAll();
        QTest::keyClicks(edit, name);
        QTest::keyClick(edit, Qt::Key_Return);
        QTest::qWait(20);
    };
    Viewport& viewport = *window.bench().viewport;
    viewport.setCamera(there, false);
    keep(QStringLiteral("bridge"));
    ASSERT_EQ(project().views.size(), 1U);
    EXPECT_EQ(project().views[0].name, "bridge");
    viewport.setCamera({{0.0, 0.0, 50.0}, {1.0, 0.0, 0.0}, 0.9}, false);
    const auto menu = window.findChild<QMenu*>(QStringLiteral("viewsMenu"));
    ASSERT_EQ(menu->actions().size(), 1);
    menu->actions().front()->trigger();
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return glm::distance(viewport.camera().position, there.position) < 1e-6; },
        test::kPatience));
    viewport.setCamera({{5.0, 5.0, 60.0}, {6.0, 5.0, 0.0}, 0.9}, false);
    keep(QStringLiteral("bridge"));
    ASSERT_EQ(project().views.size(), 1U);
    EXPECT_NEAR(project().views[0].position.z, 60.0, 1e-6);
    keep(QStringLiteral("   "));
    EXPECT_EQ(project().views.size(), 1U) << "a view needs a name";
}

TEST_F(WiringTest, DeleteOnThePlanRemovesWhatIsSelected) {
    window.document().selection()->set({ProjectItem::Kind::Probe, "p1"});
    Q_EMIT window.bench().intents->removeRequested();
    ASSERT_EQ(project().probes.size(), 1U);
    EXPECT_EQ(project().probes[0].id, "p2");
}

TEST_F(WiringTest, TheViewersConeOnThePlanMovesTheCamera) {
    const Camera there{{10.0, 20.0, 30.0}, {40.0, 20.0, 2.0}, 0.9};
    Q_EMIT window.bench().plan->cameraDragged(there, DragPhase::End);
    const Camera now = window.bench().viewport->camera();
    EXPECT_NEAR(now.position.x, there.position.x, 1e-9);
    EXPECT_NEAR(now.target.x, there.target.x, 1e-9);
}

TEST_F(WiringTest, ControlSWritesTheFileWithoutHoldingTheWindow) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "wires.reflet";
    ASSERT_TRUE(window.document().saveAs(file));
    window.document().setName("renamed");
    ASSERT_TRUE(window.document().isDirty());
    window.bench().commands->action(Command::Save)->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window.document().isDirty(); }, test::kPatience));
    const auto written = loadProject(file);
    ASSERT_TRUE(written);
    EXPECT_EQ(written->name, "renamed");
}

TEST_F(WiringTest, AMessageLiesOverThePictureWhoseSizeStaysAndMovesTheHintBelow) {
    Viewport& viewport = *window.bench().viewport;
    const QSize before = viewport.size();
    const QRect stage(QPoint(0, 0), window.bench().stage->size());
    window.bench().stage->setHint(QStringLiteral("what to do"));
    const auto* hint = window.findChild<QWidget*>(QStringLiteral("hint"));
    messages()->post({Severity::Warning,
                      QStringLiteral("A long sentence ").repeated(40),
                      {},
                      {},
                      {},
                      {QStringLiteral("Do it")}});
    ASSERT_TRUE(QTest::qWaitFor([&] { return messages()->isVisible(); }, test::kPatience));
    QTest::qWait(20);
    EXPECT_EQ(viewport.size(), before);
    EXPECT_TRUE(stage.contains(messages()->geometry()));
    EXPECT_EQ(messages()->width(), stage.width());
    for (const auto* child : messages()->findChildren<QWidget*>()) {
        if (child->isVisible()) {
            EXPECT_TRUE(messages()->rect().contains(child->geometry()))
                << child->metaObject()->className();
        }
    }
    EXPECT_GT(hint->y(), messages()->geometry().bottom());
    const int low = hint->y();
    QTest::keyClick(messages(), Qt::Key_Escape);
    EXPECT_FALSE(messages()->isVisible());
    EXPECT_EQ(viewport.size(), before);
    EXPECT_LT(hint->y(), low);
}

TEST_F(WiringTest, TheDropHintGoesWhenTheDragLeavesTheWindow) {
    window.bench().stage->setHint(QStringLiteral("before"));
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(QStringLiteral("/somewhere/town.city.json"))});
    QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &enter);
    EXPECT_NE(window.bench().stage->hint(), QStringLiteral("before"));
    QDragLeaveEvent leave;
    QCoreApplication::sendEvent(&window, &leave);
    EXPECT_EQ(window.bench().stage->hint(), QStringLiteral("before"));
}

TEST_F(WiringTest, AProjectOfANewerVersionIsRefusedWithARemedyAndNothingChanges) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "future.reflet";
    ASSERT_TRUE(saveProject(Project{}, file));
    std::ifstream in(file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    const std::string now = "\"version\": " + std::to_string(kProjectSchemaVersion);
    const auto at = text.find(now);
    ASSERT_NE(at, std::string::npos) << text;
    text.replace(at, now.size(), "\"version\": 99");
    std::ofstream(file) << text;
    EXPECT_FALSE(window.document().open(file));
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(QString::fromStdString(file.string()))});
    QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &enter);
    QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &drop);
    EXPECT_EQ(messages()->count(), 1);
    EXPECT_EQ(project().name, "wires");
}

TEST_F(WiringTest, AMissingCityFileIsToldWithAWayToLocateIt) {
    const test::TemporaryFolder folder;
    Project lost;
    lost.name = "lost";
    lost.models.push_back({{}, (folder.path() / "gone.city.json").string(), ""});
    window.document().adopt(lost);
    const auto offered = [&] {
        for (const QPushButton* button : messages()->findChildren<QPushButton*>()) {
            if (button->text() == QStringLiteral("Locate…")) {
                return true;
            }
        }
        return false;
    };
    EXPECT_TRUE(QTest::qWaitFor(offered, test::kPatience));
    EXPECT_EQ(messages()->count(), 1);
}

TEST_F(WiringTest, AMissingCityFileThatIsLocatedIsReadAndTheProjectNamesItsNewPlace) {
    const test::TemporaryFolder folder;
    test::StreetCity street(2);
    const auto found = folder.write("found.city.json", street.cityJson());
    Project lost;
    lost.name = "lost";
    lost.frame.crs = "EPSG:25832";
    lost.frame.origin = {690'000.0, 5'335'000.0, 0.0};
    lost.models.push_back({{}, (folder.path() / "gone.city.json").string(), ""});
    window.document().adopt(lost);
    QPushButton* locate = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            for (QPushButton* button : messages()->findChildren<QPushButton*>()) {
                if (button->text() == QStringLiteral("Locate…")) {
                    locate = button;
                }
            }
            return locate != nullptr;
        },
        test::kPatience));
    QTest::mouseClick(locate, Qt::LeftButton);
    QFileDialog* dialog = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            dialog = window.findChild<QFileDialog*>();
            return dialog && dialog->isVisible();
        },
        test::kPatience));
    dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))
        ->setText(QString::fromStdString(found.string()));
    QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open),
                      Qt::LeftButton);
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return window.bench().live->city() != nullptr; }, test::kPatience));
    EXPECT_EQ(modelPath(project().models.front(), window.document().folder()), found);
    EXPECT_TRUE(window.document().isDirty()) << "and it can be undone";
}

TEST_F(WiringTest, WhatACrashLeftIsBroughtBackByItsButton) {
    {
        // What the autosave of a window leaves that is gone.
        Project unsaved;
        unsaved.name = "half a tram line";
        unsaved.probes.push_back({"kept", {1.0, 2.0, 3.0}, {}, false});
        const RecoveryRecord record{unsaved, {}, {}, QDateTime::currentDateTime()};
        std::filesystem::create_directories(recoveryFolder());
        std::ofstream(recoveryFolder() / (std::string("crashed") + kRecoveryEnding))
            << recoveryToJson(record);
        ASSERT_EQ(Recovery().list().size(), 1U);
    }
    window.document().undoStack()->setClean();
    const test::TemporaryFolder folder;
    const auto other = folder.path() / "other.reflet";
    ASSERT_TRUE(saveProject(Project{}, other));
    StartOptions options;
    options.files << QString::fromStdString(other.string());
    window.start(options);
    QPushButton* back = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            for (QPushButton* button : messages()->findChildren<QPushButton*>()) {
                if (button->text() == QStringLiteral("Bring it back")) {
                    back = button;
                }
            }
            return back != nullptr;
        },
        test::kPatience));
    QTest::mouseClick(back, Qt::LeftButton);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return project().name == "half a tram line"; }, test::kPatience));
    EXPECT_EQ(project().probes.size(), 1U);
    EXPECT_TRUE(window.document().isDirty()) << "no file holds it yet";
    window.document().undoStack()->setClean();
}

}  // namespace
