// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/traffic/Vehicle.h"
#include "core/traffic/VehicleModel.h"
#include "widgets/ViewIntents.h"

#include <QWidget>
#include <memory>
#include <vector>

namespace reflet {

/// What a dialog shows of a vehicle that comes in: from the side and from above with its length and
/// its front, and what was proposed for it, to be changed. After each change the caller makes the
/// vehicle anew (in the background) and shows it with setVehicle.
class VehicleCard : public QWidget {
    Q_OBJECT

public:
    explicit VehicleCard(QWidget* parent = nullptr);
    ~VehicleCard() override;

    void setModel(const VehicleModel& model);
    [[nodiscard]] const VehicleModel& model() const;
    /// As it will stand on the road; null while it is being made.
    void setVehicle(std::shared_ptr<const Vehicle> vehicle);
    /// What was found in the file and what was done about it.
    void setRemarks(const std::vector<Diagnostic>& remarks);

Q_SIGNALS:
    void changed(reflet::VehicleModel model, reflet::DragPhase phase);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
