// SPDX-License-Identifier: GPL-3.0-or-later
// Vehicles that come as files, in the real window.
#include "app/shell/Commands.h"
#include "app/shell/MainWindow.h"
#include "app/shell/files/FileController.h"
#include "app/shell/scene/EditController.h"
#include "app/shell/vehicles/VehicleController.h"
#include "app/shell/vehicles/VehicleDialog.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/ui/Patience.h"
#include "tests/unit/importers/GltfText.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/panels/MessageBar.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <fstream>

namespace {

using namespace reflet;

class VehicleFileTest : public testing::Test {
protected:
    void SetUp() override {
        test::GltfText car;
        car.box({-0.9F, 0.2F, -2.2F}, {0.9F, 1.5F, 2.2F});
        file = folder.path() / "van.gltf";
        std::ofstream(file) << car.text();
        window.show();
        ASSERT_TRUE(QTest::qWaitForWindowActive(&window, test::kPatience));
    }
    void openStreet() {
        Project project;
        project.name = "street";
        project.routes.push_back({"street", "", {{0.0, 0.0, 0.0}, {80.0, 0.0, 0.0}}, 0.0});
        window.document().adopt(project);
    }
    VehicleDialog* bringIn(const std::filesystem::path& path) {
        window.findChild<VehicleController*>()->bringIn(QString::fromStdString(path.string()));
        VehicleDialog* dialog = nullptr;
        const auto answered = [&] {
            dialog = window.findChild<VehicleDialog*>();
            return dialog != nullptr || messages()->count() > 0;
        };
        EXPECT_TRUE(QTest::qWaitFor(answered, test::kPatience));
        return dialog;
    }
    MessageBar* messages() { return window.findChild<MessageBar*>(QStringLiteral("messageBar")); }
    static void accept(VehicleDialog* dialog) {
        dialog->findChild<QPushButton*>(QStringLiteral("vehicleAccept"))->click();
    }
    const Project& project() { return window.document().project(); }

    test::TemporaryFolder folder;
    std::filesystem::path file;
    MainWindow window;
};

TEST_F(VehicleFileTest, ADroppedVehicleShowsItsLengthAndDrivesAfterOneClick) {
    openStreet();
    auto* dialog = bringIn(file);
    ASSERT_NE(dialog, nullptr);
    auto* size = dialog->findChild<QLabel*>(QStringLiteral("vehicleSize"));
    EXPECT_TRUE(QTest::qWaitFor([&] { return size->text().contains(QStringLiteral("4.4")); },
                                test::kPatience))
        << size->text().toStdString();
    accept(dialog);
    ASSERT_EQ(project().vehicles.size(), 1U);
    ASSERT_EQ(project().reflectors.size(), 1U);
    EXPECT_EQ(project().reflectors[0].vehicle, project().vehicles[0].id);
    EXPECT_EQ(project().reflectors[0].route, "street");
    EXPECT_FALSE(project().vehicles[0].hash.empty());
}

TEST_F(VehicleFileTest, OneUndoTakesTheVehicleAndItsDriveAway) {
    openStreet();
    auto* dialog = bringIn(file);
    ASSERT_NE(dialog, nullptr);
    accept(dialog);
    EXPECT_EQ(window.document().undoStack()->count(), 1);
    window.bench().commands->action(Command::Undo)->trigger();
    EXPECT_TRUE(project().vehicles.empty());
    EXPECT_TRUE(project().reflectors.empty());
}

TEST_F(VehicleFileTest, WithoutARouteItSaysSoAndDrivesOnTheNextOne) {
    window.document().adopt(Project{});
    auto* dialog = bringIn(file);
    ASSERT_NE(dialog, nullptr);
    accept(dialog);
    ASSERT_EQ(project().vehicles.size(), 1U);
    EXPECT_TRUE(project().reflectors.empty());
    EXPECT_EQ(messages()->count(), 1);
    const std::string route = window.document().addRoute({{0.0, 0.0, 0.0}, {50.0, 0.0, 0.0}});
    Q_EMIT window.findChild<EditController*>()->routeDrawn(QString::fromStdString(route));
    ASSERT_EQ(project().reflectors.size(), 1U);
    EXPECT_EQ(project().reflectors[0].vehicle, project().vehicles[0].id);
}

TEST_F(VehicleFileTest, AFileThatIsNoVehicleIsAnErrorAndNoDialog) {
    openStreet();
    const auto broken = folder.path() / "broken.glb";
    std::ofstream(broken) << "glTF but not really";
    EXPECT_EQ(bringIn(broken), nullptr);
    EXPECT_EQ(messages()->count(), 1);
    EXPECT_TRUE(project().vehicles.empty());
}

TEST_F(VehicleFileTest, AChangeInTheInspectorChangesTheVehicle) {
    openStreet();
    auto* dialog = bringIn(file);
    ASSERT_NE(dialog, nullptr);
    accept(dialog);
    VehicleModel changed = project().vehicles[0];
    changed.scale = 2.0;
    Q_EMIT window.bench().inspector->vehicleChanged(changed, DragPhase::End);
    EXPECT_DOUBLE_EQ(project().vehicles[0].scale, 2.0);
}

}  // namespace
