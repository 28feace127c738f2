// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"
#include "core/traffic/Vehicle.h"

#include <QImage>
#include <QWidget>
#include <memory>

namespace reflet {

enum class SilhouetteView { Side, Top };

/// The outline of a vehicle, filled: alpha masks of `width` pixels for the vehicle's length, front
/// to the right. An empty vehicle gives a null image.
[[nodiscard]] QImage vehicleMask(const Vehicle& vehicle, SilhouetteView view, int width);
/// The box around all bodies of the straight vehicle: x along it, z = 0 on the ground.
[[nodiscard]] Box vehicleBox(const Vehicle& vehicle);

/// A vehicle from the side and from above, on a road, with its length and an arrow to its front.
class VehicleSilhouette : public QWidget {
    Q_OBJECT

public:
    explicit VehicleSilhouette(QWidget* parent = nullptr);
    void setVehicle(std::shared_ptr<const Vehicle> vehicle);

    [[nodiscard]] QSize sizeHint() const override { return {420, 250}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {240, 160}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::shared_ptr<const Vehicle> m_vehicle;
    QImage m_side;
    QImage m_top;
};

}  // namespace reflet
