// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/vehicle/VehicleCard.h"

#include "core/math/Geometry.h"
#include "widgets/common/Look.h"
#include "widgets/inspector/InspectorPages.h"
#include "widgets/vehicle/VehicleSilhouette.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <cmath>

namespace reflet {

namespace {

constexpr double kShortest = 1.0;  ///< metres; bicycles are longer
constexpr double kLongest = 80.0;  ///< metres; the longest trams have 60
constexpr double kMillimetre = 0.001;

}  // namespace

struct VehicleCard::Impl {
    explicit Impl(VehicleCard* owner) : card(owner) {}

    VehicleCard* card;
    VehicleModel model;
    VehicleSilhouette* silhouette = nullptr;
    QLabel* size = nullptr;
    QLabel* remarks = nullptr;
    VehiclePage* page = nullptr;
    QPushButton* millimetres = nullptr;

    void change(const VehicleModel& next, DragPhase phase) {
        model = next;
        page->show(model);
        Q_EMIT card->changed(model, phase);
    }
    void turn(double by) {
        VehicleModel next = model;
        next.heading = std::remainder(next.heading + by, 2.0 * kPi);
        change(next, DragPhase::End);
    }
    void showSize(const Vehicle* vehicle) {
        const Box box = vehicle ? vehicleBox(*vehicle) : Box{};
        millimetres->hide();
        if (box.empty()) {
            size->setText({});
            return;
        }
        const glm::dvec3 metres = box.size();
        QString text =
            tr("%1 long, %2 wide, %3 high")
                .arg(metresText(metres.x, 2), metresText(metres.y, 2), metresText(metres.z, 2));
        if (metres.x > kLongest)
            text +=
                QLatin1Char('\n') + tr("That is long for a vehicle. Is the file in millimetres?");
        else if (metres.x < kShortest)
            text += QLatin1Char('\n') + tr("That is short for a vehicle. Raise its scale.");
        millimetres->setVisible(metres.x > kLongest);
        size->setText(text);
    }
};

VehicleCard::VehicleCard(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>(this)) {
    auto* layout = new QVBoxLayout(this);
    m_impl->silhouette = new VehicleSilhouette(this);
    m_impl->size = new QLabel(this);
    m_impl->size->setObjectName(QStringLiteral("vehicleSize"));
    m_impl->size->setWordWrap(true);
    layout->addWidget(m_impl->silhouette, 1);
    layout->addWidget(m_impl->size);
    auto* turns = new QHBoxLayout;
    const auto button = [&](const char* name, const QString& text, const QString& help,
                            const std::function<void()>& act) {
        auto* made = new QPushButton(text, this);
        made->setObjectName(QString::fromLatin1(name));
        made->setToolTip(help);
        connect(made, &QPushButton::clicked, this, act);
        turns->addWidget(made);
        return made;
    };
    button("vehicleFlip", tr("&Front to back"), tr("The front is the other end"),
           [this] { m_impl->turn(kPi); });
    button("vehicleQuarter", tr("Turn by &90°"), tr("Turns the vehicle to the left"),
           [this] { m_impl->turn(0.5 * kPi); });
    m_impl->millimetres = button("vehicleMillimetres", tr("It is in &millimetres"),
                                 tr("Makes the vehicle a thousand times smaller"), [this] {
                                     VehicleModel next = m_impl->model;
                                     next.scale *= kMillimetre;
                                     m_impl->change(next, DragPhase::End);
                                 });
    turns->addStretch();
    layout->addLayout(turns);
    m_impl->page = new VehiclePage(this);
    m_impl->page->changed = [this](const VehicleModel& model, DragPhase phase) {
        m_impl->change(model, phase);
    };
    layout->addWidget(m_impl->page);
    m_impl->remarks = new QLabel(this);
    m_impl->remarks->setWordWrap(true);
    m_impl->remarks->setTextFormat(Qt::PlainText);
    layout->addWidget(m_impl->remarks);
    m_impl->showSize(nullptr);
}

VehicleCard::~VehicleCard() = default;

void VehicleCard::setModel(const VehicleModel& model) {
    m_impl->model = model;
    m_impl->page->show(model);
}

const VehicleModel& VehicleCard::model() const {
    return m_impl->model;
}

void VehicleCard::setVehicle(std::shared_ptr<const Vehicle> vehicle) {
    m_impl->showSize(vehicle.get());
    m_impl->silhouette->setVehicle(std::move(vehicle));
}

void VehicleCard::setRemarks(const std::vector<Diagnostic>& remarks) {
    QStringList lines;
    for (const Diagnostic& remark : remarks) {
        QString line = QStringLiteral("• ") + QString::fromStdString(remark.text);
        if (!remark.remedy.empty())
            line += QStringLiteral(" ") + QString::fromStdString(remark.remedy);
        lines << line;
    }
    m_impl->remarks->setText(lines.join(QLatin1Char('\n')));
    m_impl->remarks->setVisible(!lines.isEmpty());
}

}  // namespace reflet
