// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/PlaceDialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>

namespace reflet {
namespace {

constexpr double kFar = 1e8;  ///< metres
constexpr double kDegree = kPi / 180.0;

}  // namespace

PlaceDialog::PlaceDialog(const QStringList& models, QWidget* parent) : QDialog(parent) {
    setObjectName(QStringLiteral("placeDialog"));
    setWindowTitle(tr("Place a model"));
    m_models = new QComboBox;
    m_models->setObjectName(QStringLiteral("placeModel"));
    m_models->addItems(models);
    m_how = new QComboBox;
    m_how->setObjectName(QStringLiteral("placeHow"));
    m_pages = new QStackedWidget;
    m_earth = addPage(tr("By longitude and latitude"),
                      tr("Where the model's zero lies (WGS 84), and where its y axis points."),
                      {{"placeLongitude", tr("Longitude, east (°)"), 180.0, 7},
                       {"placeLatitude", tr("Latitude, north (°)"), 90.0, 7},
                       {"placeTrueHeading", tr("Heading from true north, clockwise (°)"), 360.0, 3},
                       {"placeUp", tr("Lift (m)"), 10'000.0, 2}});
    m_points = addPage(tr("By two points"),
                       tr("Two points that you know in the model and on the map, far apart. The "
                          "model is not scaled."),
                       {{"placeX1", tr("First, in the model: x (m)"), kFar, 3},
                        {"placeY1", tr("y (m)"), kFar, 3},
                        {"placeE1", tr("on the map: east (m)"), kFar, 3},
                        {"placeN1", tr("north (m)"), kFar, 3},
                        {"placeX2", tr("Second, in the model: x (m)"), kFar, 3},
                        {"placeY2", tr("y (m)"), kFar, 3},
                        {"placeE2", tr("on the map: east (m)"), kFar, 3},
                        {"placeN2", tr("north (m)"), kFar, 3}});
    m_hand = addPage(tr("By hand"), tr("Moved and turned in the project's own grid."),
                     {{"placeEast", tr("East (m)"), kFar, 3},
                      {"placeNorth", tr("North (m)"), kFar, 3},
                      {"placeHeight", tr("Up (m)"), kFar, 3},
                      {"placeHeading", tr("Heading from grid north, clockwise (°)"), 360.0, 3}});
    connect(m_how, &QComboBox::currentIndexChanged, m_pages, &QStackedWidget::setCurrentIndex);

    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    buttons->button(QDialogButtonBox::Ok)->setText(tr("&Place"));
    buttons->button(QDialogButtonBox::Ok)->setObjectName(QStringLiteral("placeAccept"));
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* form = new QFormLayout;
    form->addRow(tr("&Model"), m_models);
    form->addRow(tr("&How"), m_how);
    auto* column = new QVBoxLayout(this);
    column->addLayout(form);
    column->addWidget(m_pages, 1);
    column->addWidget(buttons);
}

PlaceDialog::Fields PlaceDialog::addPage(const QString& title, const QString& explanation,
                                         std::initializer_list<Field> fields) {
    auto* page = new QWidget;
    auto* form = new QFormLayout(page);
    auto* text = new QLabel(explanation);
    text->setWordWrap(true);
    form->addRow(text);
    Fields out;
    for (const Field& field : fields) {
        auto* box = new QDoubleSpinBox;
        box->setObjectName(QString::fromLatin1(field.name));
        box->setAccessibleName(field.label);
        box->setRange(-field.limit, field.limit);
        box->setDecimals(field.decimals);
        form->addRow(field.label, box);
        out.push_back(box);
    }
    m_how->addItem(title);
    m_pages->addWidget(page);
    return out;
}

PlaceRequest PlaceDialog::chosen() const {
    PlaceRequest request;
    request.model = m_models->currentText().toStdString();
    const int how = m_how->currentIndex();
    const Fields& fields = how == 0 ? m_earth : how == 1 ? m_points : m_hand;
    const auto at = [&](std::size_t k) { return fields[k]->value(); };
    if (how == 0)
        request.how = PlaceByLonLat{at(0), at(1), at(2) * kDegree, at(3)};
    else if (how == 1)
        request.how = PlaceByPoints{{glm::dvec2(at(0), at(1)), glm::dvec2(at(4), at(5))},
                                    {glm::dvec2(at(2), at(3)), glm::dvec2(at(6), at(7))},
                                    0.0};
    else
        request.how = PlaceByOffset{{at(0), at(1), at(2)}, at(3) * kDegree};
    return request;
}

}  // namespace reflet
