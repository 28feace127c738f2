// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/vehicles/VehicleDialog.h"

#include "app/document/JobRunner.h"
#include "widgets/vehicle/VehicleCard.h"

#include <QDialogButtonBox>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

namespace reflet {
namespace {

constexpr QSize kDialogSize(560, 680);

/// What a person should look at first, then why the rest was proposed, then the file's remarks.
std::vector<Diagnostic> remarksOf(const VehicleOffer& offer) {
    std::vector<Diagnostic> remarks;
    for (const std::string& concern : offer.proposal.concerns) {
        remarks.push_back({Severity::Warning, "vehicle-guessed", {}, concern, {}});
    }
    for (const std::string* reason : {&offer.proposal.sizeReason, &offer.proposal.frontReason,
                                      &offer.proposal.groundReason, &offer.proposal.paintReason}) {
        if (!reason->empty()) {
            remarks.push_back({Severity::Info, "vehicle-proposed", {}, *reason, {}});
        }
    }
    remarks.insert(remarks.end(), offer.remarks.begin(), offer.remarks.end());
    return remarks;
}

}  // namespace

VehicleDialog::VehicleDialog(VehicleOffer offer, JobRunner& jobs, QWidget* parent)
    : QDialog(parent), m_offer(std::move(offer)), m_jobs(jobs) {
    setObjectName(QStringLiteral("vehicleDialog"));
    setWindowTitle(tr("Add the vehicle “%1”").arg(QString::fromStdString(m_offer.model->name)));
    m_card = new VehicleCard;
    m_card->setModel(m_offer.proposal.model);
    m_card->setRemarks(remarksOf(m_offer));
    connect(m_card, &VehicleCard::changed, this, [this] { showVehicle(); });

    auto* scroll = new QScrollArea;
    scroll->setWidget(m_card);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    buttons->button(QDialogButtonBox::Ok)->setText(tr("&Add to the street"));
    buttons->button(QDialogButtonBox::Ok)->setObjectName(QStringLiteral("vehicleAccept"));
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* column = new QVBoxLayout(this);
    column->addWidget(scroll, 1);
    column->addWidget(buttons);
    resize(kDialogSize);
    showVehicle();
}

VehicleModel VehicleDialog::chosen() const {
    VehicleModel model = m_card->model();
    model.id = m_offer.proposal.model.id;
    model.path = m_offer.proposal.model.path;
    model.hash = m_offer.proposal.model.hash;
    return model;
}

void VehicleDialog::showVehicle() {
    using Made = std::shared_ptr<const Vehicle>;
    m_jobs.run<Made>(
        {.title = tr("Setting the vehicle up"),
         .lane = QStringLiteral("vehicleDialog"),
         .visible = false},
        [model = m_offer.model, fit = m_card->model()](const JobContext&) -> Result<Made> {
            return std::make_shared<const Vehicle>(makeVehicle(*model, fit));
        },
        this,
        [this](const Result<Made>& made) {
            if (made) {
                m_card->setVehicle(*made);
            }
        });
}

}  // namespace reflet
