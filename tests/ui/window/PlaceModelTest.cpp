// SPDX-License-Identifier: GPL-3.0-or-later
// A model without coordinates comes to its place, and a terrain under its buildings.
#include "app/document/JobRunner.h"
#include "app/pipeline/GroundModels.h"
#include "app/pipeline/PreparedCity.h"
#include "app/shell/Commands.h"
#include "tests/ui/window/WindowTestSupport.h"
#include "widgets/panels/MessageBar.h"

#include <QDialog>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QUndoStack>
#include <QUrl>
#include <algorithm>
#include <cmath>

namespace reflet::test {
namespace {

class PlaceModelTest : public WindowTest {
protected:
    /// The street without any CRS: the middle of its road runs from (0, 0) to (60, 0).
    std::filesystem::path local() {
        StreetCity bare(6, 0.0, 0.0, 0.0);
        return folder.write("local.city.json", bare.cityJson({}));
    }
    /// Through the menu, with keys alone.
    static void askByKeys(MainWindow& window, QDialog*& dialog) {
        press(window, Qt::Key_F, Qt::AltModifier);
        ASSERT_TRUE(QTest::qWaitFor([] { return QApplication::activePopupWidget() != nullptr; },
                                    kPatience));
        QTest::keyClick(QApplication::activePopupWidget(), Qt::Key_L);
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                dialog = window.findChild<QDialog*>(QStringLiteral("placeDialog"));
                return dialog && dialog->isVisible();
            },
            kPatience));
    }
    static void choose(QDialog& dialog, int way) {
        auto* how = dialog.findChild<QComboBox*>(QStringLiteral("placeHow"));
        how->setFocus();
        QTest::keyClick(how, Qt::Key_Home);
        for (int k = 0; k < way; ++k)
            QTest::keyClick(how, Qt::Key_Down);
        ASSERT_EQ(how->currentIndex(), way);
    }
    static void type(QDialog& dialog, const char* field, const QString& text) {
        auto* box = dialog.findChild<QDoubleSpinBox*>(QString::fromLatin1(field));
        ASSERT_NE(box, nullptr) << field;
        ASSERT_TRUE(box->isVisible()) << field;
        box->setFocus();
        box->selectAll();
        QTest::keyClicks(box, text);
        QTest::keyClick(box, Qt::Key_Tab);
    }
    static QPushButton& accept(const QDialog& dialog) {
        return *dialog.findChild<QPushButton*>(QStringLiteral("placeAccept"));
    }
    static QString note(const QDialog& dialog) {
        return dialog.findChild<QLabel*>(QStringLiteral("placeNote"))->text();
    }
    static bool closed(const MainWindow& window) {
        return QTest::qWaitFor(
            [&] { return window.findChild<QDialog*>(QStringLiteral("placeDialog")) == nullptr; },
            kPatience);
    }
    /// Where the model's own (x, y, z) is told to be, in the project's coordinates.
    static glm::dvec3 placed(MainWindow& window, const glm::dvec3& point) {
        const auto& placement = window.document().project().models.front().placement;
        return placement ? *placement * point : point;
    }
    static void expectNear(const glm::dvec3& is, const glm::dvec3& wanted) {
        EXPECT_NEAR(is.x, wanted.x, 1e-3);
        EXPECT_NEAR(is.y, wanted.y, 1e-3);
        EXPECT_NEAR(is.z, wanted.z, 1e-3);
    }
    static void undo(MainWindow& window) { press(window, Qt::Key_Z, Qt::ControlModifier); }
};

TEST_F(PlaceModelTest, ByHandIsOneStepThatUndoTakesBackAndTheDialogKnowsWhereItStands) {
    MainWindow window;
    open(window, local());
    if (HasFatalFailure())
        return;
    const std::string before = json(window);
    QDialog* dialog = nullptr;
    askByKeys(window, dialog);
    ASSERT_NE(dialog, nullptr);
    choose(*dialog, 2);
    type(*dialog, "placeEast", QStringLiteral("100"));
    type(*dialog, "placeNorth", QStringLiteral("200"));
    type(*dialog, "placeHeight", QStringLiteral("-5.5"));
    type(*dialog, "placeHeading", QStringLiteral("90"));
    QTest::mouseClick(&accept(*dialog), Qt::LeftButton);
    ASSERT_TRUE(closed(window));
    // The model's +y points east now, its +x south.
    expectNear(placed(window, {10.0, 0.0, 0.0}), {100.0, 190.0, -5.5});
    expectNear(placed(window, {0.0, 10.0, 2.0}), {110.0, 200.0, -3.5});
    const std::string after = json(window);

    askByKeys(window, dialog);
    ASSERT_NE(dialog, nullptr);
    choose(*dialog, 2);
    EXPECT_NEAR(dialog->findChild<QDoubleSpinBox*>(QStringLiteral("placeHeading"))->value(), 90.0,
                1e-9);
    QTest::keyClick(dialog, Qt::Key_Escape);
    ASSERT_TRUE(closed(window));
    EXPECT_EQ(json(window), after) << "Escape places nothing";

    undo(window);
    EXPECT_EQ(json(window), before);
    press(window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(json(window), after);
    window.document().undoStack()->setClean();
}

TEST_F(PlaceModelTest, ByTwoPointsItTurnsAndABadPairIsToldBeforeItIsPlaced) {
    MainWindow window;
    open(window, local());
    if (HasFatalFailure())
        return;
    const std::string before = json(window);
    QDialog* dialog = nullptr;
    askByKeys(window, dialog);
    ASSERT_NE(dialog, nullptr);
    choose(*dialog, 1);
    EXPECT_FALSE(accept(*dialog).isEnabled()) << "all points are one";
    EXPECT_FALSE(note(*dialog).isEmpty());
    type(*dialog, "placeX2", QStringLiteral("60"));
    type(*dialog, "placeE1", QStringLiteral("500"));
    type(*dialog, "placeN1", QStringLiteral("700"));
    type(*dialog, "placeE2", QStringLiteral("500"));
    EXPECT_TRUE(accept(*dialog).isEnabled());
    EXPECT_TRUE(note(*dialog).contains(QStringLiteral("700.00"))) << "60 m are 700 m on the map";
    type(*dialog, "placeN2", QStringLiteral("700"));
    EXPECT_FALSE(accept(*dialog).isEnabled()) << "both points lie together on the map";
    QTest::keyClick(dialog, Qt::Key_Return);
    EXPECT_TRUE(dialog->isVisible());
    EXPECT_EQ(json(window), before);
    type(*dialog, "placeN2", QStringLiteral("760"));
    EXPECT_TRUE(note(*dialog).isEmpty()) << note(*dialog).toStdString();
    QTest::keyClick(&accept(*dialog), Qt::Key_Space);
    ASSERT_TRUE(closed(window));
    expectNear(placed(window, {0.0, 0.0, 0.0}), {500.0, 700.0, 0.0});
    expectNear(placed(window, {60.0, 0.0, 0.0}), {500.0, 760.0, 0.0});
    // A left turn by a right angle: what lay north of the road lies west of it.
    expectNear(placed(window, {0.0, 10.0, 0.0}), {490.0, 700.0, 0.0});
    undo(window);
    EXPECT_EQ(json(window), before);
    window.document().undoStack()->setClean();
}

TEST_F(PlaceModelTest, ByLongitudeAndLatitudeTheProjectComesIntoItsZone) {
    MainWindow window;
    open(window, local());
    if (HasFatalFailure())
        return;
    const std::string before = json(window);
    QDialog* dialog = nullptr;
    askByKeys(window, dialog);
    ASSERT_NE(dialog, nullptr);
    EXPECT_FALSE(accept(*dialog).isEnabled()) << "nobody means the Gulf of Guinea";
    // No zone of UTM: it is told where the numbers are, and they can be corrected.
    type(*dialog, "placeLongitude", QStringLiteral("9"));
    type(*dialog, "placeLatitude", QStringLiteral("89.5"));
    QTest::mouseClick(&accept(*dialog), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !note(*dialog).isEmpty(); }, kPatience));
    EXPECT_TRUE(dialog->isVisible());
    EXPECT_EQ(json(window), before);
    type(*dialog, "placeLatitude", QStringLiteral("48"));
    QTest::mouseClick(&accept(*dialog), Qt::LeftButton);
    ASSERT_TRUE(closed(window));
    EXPECT_EQ(window.document().project().frame.crs, "EPSG:32632");
    // 9° is the zone's middle: 500 km east, and grid north is true north. The meridian's arc from
    // the equator to 48° is 5 318 km long on WGS 84 (by the series of Helmert), times 0.9996.
    const glm::dvec3 zero = placed(window, {0.0, 0.0, 0.0});
    EXPECT_NEAR(zero.x, 500'000.0, 1e-3);
    EXPECT_NEAR(zero.y, 5'316'300.0, 1'000.0);
    EXPECT_NEAR(placed(window, {0.0, 10.0, 0.0}).x, 500'000.0, 1e-3);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return !window.bench().live->loading() && window.bench().live->city(); }, kPatience));
    undo(window);
    EXPECT_EQ(json(window), before);
    window.document().undoStack()->setClean();
}

TEST_F(PlaceModelTest, AModelThatKnowsItsPlaceCanOnlyBeMoved) {
    MainWindow window;
    open(window, city);
    if (HasFatalFailure())
        return;
    QDialog* dialog = nullptr;
    askByKeys(window, dialog);
    ASSERT_NE(dialog, nullptr);
    auto* how = dialog->findChild<QComboBox*>(QStringLiteral("placeHow"));
    EXPECT_FALSE(how->isEnabled());
    EXPECT_FALSE(dialog->findChild<QDoubleSpinBox*>(QStringLiteral("placeHeading"))->isEnabled());
    EXPECT_FALSE(note(*dialog).isEmpty());
    type(*dialog, "placeHeight", QStringLiteral("43.2"));
    QTest::mouseClick(&accept(*dialog), Qt::LeftButton);
    ASSERT_TRUE(closed(window));
    expectNear(placed(window, {690'000.0, 5'335'000.0, 0.0}), {690'000.0, 5'335'000.0, 43.2});
    window.document().undoStack()->setClean();
}

TEST_F(PlaceModelTest, WithoutAModelThereIsNothingToPlace) {
    MainWindow window;
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window, kPatience));
    EXPECT_FALSE(window.bench().commands->action(Command::PlaceModel)->isEnabled());
    window.document().adopt([] {
        Project project;
        project.models.push_back({{}, "gone.city.json", ""});
        return project;
    }());
    EXPECT_TRUE(window.bench().commands->action(Command::PlaceModel)->isEnabled());
    QDialog* dialog = nullptr;
    askByKeys(window, dialog);
    ASSERT_NE(dialog, nullptr);
    choose(*dialog, 2);
    QTest::mouseClick(&accept(*dialog), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !note(*dialog).isEmpty(); }, kPatience))
        << "a file that is gone is told in the dialog";
    EXPECT_TRUE(dialog->isVisible());
    EXPECT_TRUE(window.document().project().models.front().placement == std::nullopt);
}

/// Buildings whose bases stand at 46.3 m, and a raster of the ground at 0 m.
class TerrainTest : public PlaceModelTest {
protected:
    static constexpr double kOff = 46.3;

    std::filesystem::path houses() {
        StreetCity high(6, 690'000.0, 5'335'000.0, kOff);
        auto root = nlohmann::json::parse(high.cityJson());
        root["CityObjects"].erase("ground");
        return folder.write("high.city.json", root.dump());
    }
    std::filesystem::path ground() {
        std::string text = "ncols 80\nnrows 60\nxllcorner 689960\nyllcorner 5334940\ncellsize 2\n";
        for (int k = 0; k < 80 * 60; ++k)
            text += "0 ";
        return folder.write("ground.asc", text);
    }
    static void drop(MainWindow& window, const std::filesystem::path& file) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(QString::fromStdString(file.string()))});
        QDragEnterEvent enter(QPoint(100, 100), Qt::CopyAction, &data, Qt::LeftButton,
                              Qt::NoModifier);
        QApplication::sendEvent(&window, &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent event(QPointF(100, 100), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&window, &event);
    }
    static QPushButton* button(const MainWindow& window, const QString& text) {
        const auto* bar = window.findChild<MessageBar*>(QStringLiteral("messageBar"));
        for (QPushButton* found : bar->findChildren<QPushButton*>())
            if (found->text() == text && found->isVisible())
                return found;
        return nullptr;
    }
    static std::optional<double> fit(const MainWindow& window) {
        const auto prepared = window.bench().live->prepared();
        const auto found = prepared ? groundFit(prepared->city()) : std::nullopt;
        return found ? std::optional(found->median) : std::nullopt;
    }
    static bool untilModels(MainWindow& window, std::size_t count) {
        return QTest::qWaitFor(
            [&] {
                return window.document().project().models.size() == count &&
                       !window.bench().live->loading() && window.bench().live->city();
            },
            kPatience);
    }
};

TEST_F(TerrainTest, ADroppedTerrainThatLiesOffIsMovedUnderTheHousesByItsButton) {
    MainWindow window;
    open(window, houses());
    if (HasFatalFailure())
        return;
    EXPECT_TRUE(window.bench().live->prepared()->loaded().generatedGround);
    drop(window, ground());
    ASSERT_TRUE(untilModels(window, 2)) << "a raster is added without a question";
    EXPECT_EQ(window.document().project().models[1].use, ModelUse::Terrain);
    EXPECT_FALSE(window.bench().live->prepared()->loaded().generatedGround);
    ASSERT_TRUE(fit(window));
    EXPECT_NEAR(*fit(window), kOff, 1e-3);
    QPushButton* move = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return (move = button(window, QStringLiteral("Move the terrain"))) != nullptr; },
        kPatience));
    const std::string before = json(window);
    QTest::mouseClick(move, Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            return !window.bench().live->loading() && fit(window) && std::abs(*fit(window)) < 1e-3;
        },
        kPatience));
    EXPECT_EQ(button(window, QStringLiteral("Move the terrain")), nullptr);
    undo(window);
    EXPECT_EQ(json(window), before);
    window.document().undoStack()->setClean();
}

TEST_F(TerrainTest, ACityWithNorthFirstIsTurnedByItsButtonAndBackByUndo) {
    const auto path = folder.write(
        "exchanged.city.json", withAxesExchanged(StreetCity(6, 690'000.0, 5'335'000.0).cityJson()));
    MainWindow window;
    open(window, path);
    if (HasFatalFailure())
        return;
    QPushButton* exchange = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            return (exchange = button(window, QStringLiteral("Exchange east and north"))) !=
                   nullptr;
        },
        kPatience));
    const std::string before = json(window);
    EXPECT_EQ(window.document().project().frame.origin, glm::dvec3(5'335'000, 690'000, 0));
    QTest::mouseClick(exchange, Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            return !window.bench().live->loading() &&
                   window.document().project().frame.origin == glm::dvec3(690'000, 5'335'000, 0);
        },
        kPatience));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return !window.bench().live->loading() && window.bench().live->city(); }, kPatience));
    const Box bounds = window.bench().live->prepared()->city().bounds();
    EXPECT_GT(bounds.size().x, bounds.size().y) << "the street runs east";
    EXPECT_EQ(button(window, QStringLiteral("Exchange east and north")), nullptr);
    undo(window);
    EXPECT_EQ(json(window), before);
    window.document().undoStack()->setClean();
}

TEST_F(TerrainTest, AnOfferThatTheProjectHasOutgrownMovesNothing) {
    MainWindow window;
    open(window, houses());
    if (HasFatalFailure())
        return;
    drop(window, ground());
    ASSERT_TRUE(untilModels(window, 2));
    QPushButton* move = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return (move = button(window, QStringLiteral("Move the terrain"))) != nullptr; },
        kPatience));
    undo(window);
    ASSERT_EQ(window.document().project().models.size(), 1U);
    const std::string before = json(window);
    QTest::mouseClick(move, Qt::LeftButton);
    EXPECT_EQ(json(window), before);
    window.document().undoStack()->setClean();
}

TEST_F(TerrainTest, ARasterThatIsCutOffIsRefusedByNameAndNothingIsLost) {
    MainWindow window;
    open(window, houses());
    if (HasFatalFailure())
        return;
    const std::string before = json(window);
    const auto* bar = window.findChild<MessageBar*>(QStringLiteral("messageBar"));
    const int told = bar->count();
    drop(window, folder.write("short.asc",
                              "ncols 80\nnrows 60\nxllcorner 689960\nyllcorner "
                              "5334940\ncellsize 2\n1 2 3\n"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return bar->count() > told; }, kPatience));
    drop(window, folder.write("picture.tif", "II*"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return bar->count() > told + 1; }, kPatience));
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.bench().jobs->isIdle(); }, kPatience));
    EXPECT_EQ(json(window), before);
    EXPECT_TRUE(
        bar->findChild<QLabel*>(QStringLiteral("messageText"))->text().contains("short.asc"));
    window.document().undoStack()->setClean();
}

TEST_F(TerrainTest, ASecondCityIsAddedOrOpenedAsTheUserSays) {
    MainWindow window;
    open(window, houses());
    if (HasFatalFailure())
        return;
    StreetCity beside(2, 690'200.0, 5'335'000.0, kOff);
    const auto second = folder.write("beside.city.json", beside.cityJson());
    drop(window, second);
    QPushButton* add = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return (add = button(window, QStringLiteral("Add it to this project"))) != nullptr; },
        kPatience));
    EXPECT_EQ(window.document().project().models.size(), 1U);
    QTest::mouseClick(add, Qt::LeftButton);
    ASSERT_TRUE(untilModels(window, 2));
    EXPECT_EQ(window.bench().live->reports().size(), 2U);
    window.document().undoStack()->setClean();
    drop(window, second);
    QPushButton* instead = nullptr;
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            return (instead = button(window, QStringLiteral("Open it in place of this one"))) !=
                   nullptr;
        },
        kPatience));
    QTest::mouseClick(instead, Qt::LeftButton);
    ASSERT_TRUE(untilModels(window, 1));
    EXPECT_TRUE(window.document().project().models[0].path.ends_with("beside.city.json"));
    window.document().undoStack()->setClean();
}

}  // namespace
}  // namespace reflet::test
