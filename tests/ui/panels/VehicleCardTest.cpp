// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/panels/PanelTestSupport.h"
#include "widgets/common/NumberEdit.h"
#include "widgets/vehicle/VehicleCard.h"
#include "widgets/vehicle/VehicleSilhouette.h"

#include <QLabel>
#include <QPushButton>
#include <vector>

namespace reflet {
namespace {

std::shared_ptr<const Vehicle> car() {
    return std::make_shared<const Vehicle>(builtInVehicle("car").value());
}

/// Everything a thousand times as large.
std::shared_ptr<const Vehicle> carInMillimetres() {
    Vehicle vehicle = *car();
    for (VehicleBody& body : vehicle.bodies)
        for (glm::vec3& vertex : body.vertices)
            vertex *= 1000.0F;
    return std::make_shared<const Vehicle>(vehicle);
}

TEST(VehicleSilhouetteTest, TheMaskIsFullInsideAndEmptyOutside) {
    const QImage side = vehicleMask(*car(), SilhouetteView::Side, 400);
    ASSERT_FALSE(side.isNull());
    EXPECT_EQ(side.width(), 400);
    EXPECT_EQ(qAlpha(side.pixel(200, side.height() / 2)), 255) << "a door";
    EXPECT_EQ(qAlpha(side.pixel(2, 2)), 0) << "the air above the bonnet";
    EXPECT_TRUE(vehicleMask(Vehicle{}, SilhouetteView::Top, 400).isNull());
}

TEST(VehicleCardTest, FrontToBackTurnsByHalfACircleAndTwiceIsNothing) {
    VehicleCard card;
    card.setModel(VehicleModel{});
    card.setVehicle(car());
    test::showWidget(card, 440, 620);
    std::vector<VehicleModel> changes;
    QObject::connect(&card, &VehicleCard::changed,
                     [&](const VehicleModel& model, DragPhase) { changes.push_back(model); });
    auto* flip = test::child<QPushButton>(card, "vehicleFlip");
    QTest::mouseClick(flip, Qt::LeftButton);
    QTest::mouseClick(flip, Qt::LeftButton);
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_NEAR(std::abs(changes[0].heading), 3.14159265, 1e-6);
    EXPECT_NEAR(changes[1].heading, 0.0, 1e-9);
}

TEST(VehicleCardTest, AVehicleOfKilometresIsAskedWhetherItIsInMillimetres) {
    VehicleCard card;
    card.setModel(VehicleModel{});
    card.setVehicle(car());
    test::showWidget(card, 440, 620);
    auto* millimetres = test::child<QPushButton>(card, "vehicleMillimetres");
    EXPECT_FALSE(millimetres->isVisible());
    card.setVehicle(carInMillimetres());
    ASSERT_TRUE(millimetres->isVisible());
    EXPECT_TRUE(
        test::child<QLabel>(card, "vehicleSize")->text().contains(QStringLiteral("millimetres")));
    QTest::mouseClick(millimetres, Qt::LeftButton);
    EXPECT_DOUBLE_EQ(card.model().scale, 0.001);
    EXPECT_DOUBLE_EQ(test::child<NumberEdit>(card, "vehicleScale")->value(), 0.001);
}

}  // namespace
}  // namespace reflet
