// SPDX-License-Identifier: GPL-3.0-or-later
// A glTF file that is dropped is a city or a vehicle, in the real window.
#include "app/shell/MainWindow.h"
#include "app/shell/files/DroppedFiles.h"
#include "app/shell/files/FileController.h"
#include "app/shell/vehicles/VehicleDialog.h"
#include "core/project/Project.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/ui/Patience.h"
#include "tests/unit/importers/GltfText.h"
#include "widgets/panels/MessageBar.h"

#include <gtest/gtest.h>

#include <QPushButton>
#include <QTest>

namespace {

using namespace reflet;

class DroppedGltfTest : public testing::Test {
protected:
    void SetUp() override {
        window.show();
        ASSERT_TRUE(QTest::qWaitForWindowActive(&window, test::kPatience));
    }
    /// A box of this size: length, height, width; y is up.
    QString box(const char* name, const glm::vec3& size, bool place = false) {
        test::GltfText gltf;
        gltf.box({0, 0, 0}, size);
        if (place)
            gltf.root["asset"]["extras"]["georeference"] = {{"crs", "EPSG:25832"},
                                                            {"origin", {565000, 5934000, 0}}};
        return QString::fromStdString(folder.write(name, gltf.text()).string());
    }
    void drop(const QString& file) { window.findChild<FileController*>()->openPaths({file}); }
    void openDistrict() {
        Project project;
        project.name = "district";
        const QString file = box("open.gltf", {300, 20, 200});
        ModelReference& model = project.models.emplace_back();
        model.path = file.toStdString();
        model.crs = "local";
        window.document().adopt(project);
    }
    [[nodiscard]] const Project& project() { return window.document().project(); }
    [[nodiscard]] VehicleDialog* vehicleDialog() { return window.findChild<VehicleDialog*>(); }
    QPushButton* button(const char* label) {
        for (auto* found : window.findChild<MessageBar*>(QStringLiteral("messageBar"))
                               ->findChildren<QPushButton*>()) {
            if (found->text().contains(QLatin1String(label)))
                return found;
        }
        return nullptr;
    }

    test::TemporaryFolder folder;
    MainWindow window;
};

TEST_F(DroppedGltfTest, ADistrictIsOpenedAsACityAtOnce) {
    drop(box("district.gltf", {300, 20, 200}));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !project().models.empty(); }, test::kPatience));
    EXPECT_NE(project().models[0].path.find("district.gltf"), std::string::npos);
    EXPECT_EQ(vehicleDialog(), nullptr);
}

TEST_F(DroppedGltfTest, AFileThatSaysWhereItLiesIsACityHoweverSmall) {
    drop(box("hut.gltf", {5, 3, 4}, true));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !project().models.empty(); }, test::kPatience));
    EXPECT_EQ(project().frame.crs, "EPSG:25832");
}

TEST_F(DroppedGltfTest, WithoutACityItIsAskedWhatASmallOneIs) {
    const QString file = box("van.gltf", {4.4F, 1.5F, 1.8F});
    drop(file);
    ASSERT_NE(button("It is a vehicle"), nullptr);
    EXPECT_EQ(vehicleDialog(), nullptr);
    button("It is a vehicle")->click();
    EXPECT_TRUE(QTest::qWaitFor([&] { return vehicleDialog() != nullptr; }, test::kPatience));
    EXPECT_TRUE(project().models.empty());
}

TEST_F(DroppedGltfTest, WithoutACityASmallOneCanBecomeIt) {
    drop(box("house.gltf", {9, 8, 8}));
    ASSERT_NE(button("Open it as a city"), nullptr);
    button("Open it as a city")->click();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !project().models.empty(); }, test::kPatience));
}

TEST_F(DroppedGltfTest, InACityASmallOneIsAVehicleWithoutAQuestion) {
    openDistrict();
    drop(box("van.gltf", {4.4F, 1.5F, 1.8F}));
    EXPECT_EQ(button("It is a vehicle"), nullptr);
    EXPECT_TRUE(QTest::qWaitFor([&] { return vehicleDialog() != nullptr; }, test::kPatience));
}

TEST_F(DroppedGltfTest, AVehicleInCentimetresIsAskedAfterAndACityIsNot) {
    const QString car = box("car.gltf", {440, 150, 180});
    const QString quarter = box("quarter.gltf", {440, 40, 180});
    const DroppedFiles sorted = sortDropped({car, quarter});
    EXPECT_EQ(sorted.unclear, QStringList{car});
    EXPECT_EQ(sorted.cities, QStringList{quarter});
    openDistrict();
    drop(car);
    EXPECT_NE(button("It is a vehicle"), nullptr);
    EXPECT_NE(button("Open it as a city"), nullptr);
}

}  // namespace
