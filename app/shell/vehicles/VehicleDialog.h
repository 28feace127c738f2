// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/VehicleFile.h"

#include <QDialog>
#include <memory>

namespace reflet {

class JobRunner;
class VehicleCard;

/// Shows a vehicle that comes in as it would stand on the road, and what is proposed for it: its
/// length, its front, its paint. All can be changed before it is taken.
class VehicleDialog : public QDialog {
    Q_OBJECT
public:
    VehicleDialog(VehicleOffer offer, JobRunner& jobs, QWidget* parent);

    /// As chosen; path and hash are those of the offer.
    [[nodiscard]] VehicleModel chosen() const;

private:
    void showVehicle();

    VehicleOffer m_offer;
    JobRunner& m_jobs;
    VehicleCard* m_card;
};

}  // namespace reflet
