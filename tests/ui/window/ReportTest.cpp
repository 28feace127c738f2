// SPDX-License-Identifier: GPL-3.0-or-later
// The import report, and a new delivery of a city, through the window.
#include "app/shell/Commands.h"
#include "app/shell/files/UpdateController.h"
#include "app/shell/files/UpdateDialog.h"
#include "tests/ui/window/WindowTestSupport.h"
#include "widgets/panels/ReportPanel.h"

#include <nlohmann/json.hpp>

#include <QLabel>
#include <QTableView>
#include <QTreeWidget>
#include <QUndoStack>

namespace reflet::test {
namespace {

class ReportTest : public WindowTest {
protected:
    /// The street with a house, "holed", of whose surfaces one has a vertex that does not exist,
    /// and with "lost", which has no other.
    std::filesystem::path oddCity() {
        auto root = nlohmann::json::parse(street.cityJson());
        auto& objects = root["CityObjects"];
        objects["holed"] = objects["north-2"];
        objects.erase("north-2");
        auto& boundaries = objects["holed"]["geometry"][0]["boundaries"];
        auto& shell =
            objects["holed"]["geometry"][0]["type"] == "Solid" ? boundaries[0] : boundaries;
        shell.push_back({{0, 1, 999'999}});
        objects["lost"] = {{"type", "Bridge"},
                           {"geometry",
                            {{{"type", "MultiSurface"},
                              {"lod", "1"},
                              {"boundaries", {{{999'997, 999'998, 999'999}}}}}}}};
        return folder.write("odd.city.json", root.dump());
    }
    static void follow(MainWindow& window, const QString& object) {
        auto* table = window.bench().report->findChild<QTableView*>();
        ASSERT_NE(table, nullptr);
        for (int row = 0; row < table->model()->rowCount(); ++row) {
            if (table->model()->index(row, 1).data().toString() != object)
                continue;
            table->setCurrentIndex(table->model()->index(row, 0));
            table->setFocus();
            QTest::keyClick(table, Qt::Key_Return);
            return;
        }
        FAIL() << "no remark on " << object.toStdString();
    }
    static void keepPicture(MainWindow& window, const char* name) {
        const QString folder = qEnvironmentVariable("REFLET_GALLERY");
        if (folder.isEmpty())
            return;
        QTest::qWait(1500);
        EXPECT_TRUE(window.grab().save(folder + QLatin1Char('/') + QLatin1String(name)));
    }
};

TEST_F(ReportTest, LeadsFromTheMessageOfAnImportToTheObjectAndIntoAFile) {
    MainWindow window;
    open(window, oddCity());
    if (HasFatalFailure())
        return;
    auto* panel = window.bench().report;
    EXPECT_FALSE(panel->isVisible());
    QPushButton* show = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            for (auto* button : window.findChildren<QPushButton*>())
                if (button->text() == QStringLiteral("Show the report"))
                    show = button;
            return show != nullptr;
        },
        kPatience));
    QTest::mouseClick(show, Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel->isVisible(); }, kPatience));
    EXPECT_GE(panel->remarks()->shownCount(), 2);

    Viewport& viewport = *window.bench().viewport;
    viewport.setReducedMotion(true);
    follow(window, QStringLiteral("holed"));
    EXPECT_EQ(viewport.markedObject(), QStringLiteral("holed"));
    // The house is in the middle of the picture.
    const glm::dvec3 house(24.5, 10.0, 3.0);
    const glm::dvec3 origin = window.document().project().frame.origin;
    const glm::dvec3 at = house + glm::dvec3(690'000.0, 5'335'000.0, 0.0) - origin;
    const ProjectedPoint seen = viewport.geometry().project(at);
    EXPECT_GT(seen.depth, 0.0);
    EXPECT_NEAR(seen.pixel.x, 0.5 * viewport.width(), 0.2 * viewport.width());
    EXPECT_NEAR(seen.pixel.y, 0.5 * viewport.height(), 0.25 * viewport.height());
    keepPicture(window, "window-report.png");
    QTest::keyClick(&viewport, Qt::Key_Escape);
    EXPECT_TRUE(viewport.markedObject().isEmpty());
    follow(window, QStringLiteral("lost"));
    EXPECT_TRUE(viewport.markedObject().isEmpty()) << "nothing of it is there to be shown";

    QTest::mouseClick(panel->findChild<QPushButton*>(QStringLiteral("reportSave")), Qt::LeftButton);
    answerFileDialog(window, "reportSaveDialog", folder / "report.json");
    const auto report = nlohmann::json::parse(bytesOf(folder / "report.json"));
    EXPECT_EQ(report["schema"], "reflet-import-report");
    EXPECT_EQ(report["files"][0]["accounts"].size(), std::size_t(street.objects()) + 1);
}

TEST_F(ReportTest, ComesFromTheMenuAndAgainWhenTheProjectIsOpened) {
    const auto file = folder / "odd.reflet";
    {
        MainWindow window;
        open(window, oddCity());
        if (HasFatalFailure())
            return;
        ASSERT_TRUE(window.document().saveAs(file));
    }
    MainWindow window;
    open(window, file);
    if (HasFatalFailure())
        return;
    auto* panel = window.bench().report;
    window.bench().commands->action(Command::ShowReport)->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel->isVisible(); }, kPatience));
    EXPECT_GE(panel->remarks()->shownCount(), 2);
}

class UpdateTest : public ReportTest {
protected:
    static UpdateDialog* compare(MainWindow& window, const std::filesystem::path& file) {
        auto* controller = window.findChild<UpdateController*>();
        EXPECT_NE(controller, nullptr);
        controller->compare(window.document().project().models.front().path,
                            QString::fromStdString(file.string()));
        UpdateDialog* dialog = nullptr;
        EXPECT_TRUE(QTest::qWaitFor(
            [&] {
                dialog = window.findChild<UpdateDialog*>();
                return dialog != nullptr && dialog->isVisible();
            },
            kPatience));
        return dialog;
    }
    static bool holds(MainWindow& window, const std::string& object) {
        const auto prepared = window.bench().live->prepared();
        if (!prepared || window.bench().live->loading())
            return false;
        for (const CityObject& one : prepared->city().objects)
            if (one.id == object)
                return true;
        return false;
    }
};

TEST_F(UpdateTest, ListsWhatChangesTakesItAndTakesItBack) {
    MainWindow window;
    open(window, city);
    if (HasFatalFailure())
        return;
    window.document().addProbe(window.document().project().frame.origin + glm::dvec3(20, 0, 2));
    const std::string before = json(window);
    UpdateDialog* dialog = compare(window, oddCity());
    ASSERT_NE(dialog, nullptr);
    EXPECT_EQ(json(window), before) << "nothing is changed before it is wanted";
    auto* tree = dialog->findChild<QTreeWidget*>(QStringLiteral("updateChanges"));
    ASSERT_NE(tree, nullptr);
    ASSERT_EQ(tree->topLevelItemCount(), 4);
    EXPECT_EQ(tree->topLevelItem(0)->child(0)->text(0), QStringLiteral("holed"));
    EXPECT_EQ(tree->topLevelItem(1)->child(0)->text(0), QStringLiteral("north-2"));
    EXPECT_EQ(tree->topLevelItem(2)->childCount(), 0);
    EXPECT_EQ(tree->topLevelItem(3)->childCount(), 1) << "the probe stands near";
    keepPicture(window, "window-update.png");
    if (const QString gallery = qEnvironmentVariable("REFLET_GALLERY"); !gallery.isEmpty()) {
        EXPECT_TRUE(dialog->grab().save(gallery + QStringLiteral("/update-dialog.png")));
    }
    QTest::mouseClick(dialog->findChild<QPushButton*>(QStringLiteral("updateApply")),
                      Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return holds(window, "holed"); }, kPatience));
    EXPECT_FALSE(holds(window, "north-2"));
    EXPECT_EQ(window.document().project().probes.size(), 1U);
    window.document().undoStack()->undo();
    EXPECT_EQ(json(window), before) << "one step";
    EXPECT_TRUE(QTest::qWaitFor([&] { return holds(window, "north-2"); }, kPatience));
}

TEST_F(UpdateTest, SaysThatTheSameFileChangesNothing) {
    MainWindow window;
    open(window, city);
    if (HasFatalFailure())
        return;
    const std::string before = json(window);
    window.findChild<UpdateController*>()->compare(window.document().project().models.front().path,
                                                   QString::fromStdString(city.string()));
    const auto said = [&] {
        for (auto* label : window.findChildren<QLabel*>())
            if (label->isVisible() && label->text().contains(QStringLiteral("Nothing has changed")))
                return true;
        return false;
    };
    EXPECT_TRUE(QTest::qWaitFor(said, kPatience));
    EXPECT_EQ(json(window), before);
    EXPECT_EQ(window.findChild<UpdateDialog*>(), nullptr);
}

}  // namespace
}  // namespace reflet::test
