// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/PlaceDialog.h"

#include "widgets/panels/MessageBar.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

constexpr double kFar = 1e8;  ///< metres
constexpr double kDegree = kPi / 180.0;
constexpr double kNearest = 0.1;           ///< metres between two points of a pair
constexpr double kTolerableRatio = 0.005;  ///< of the distances on the map and in the model

constexpr int kBoxRoom = 40;  ///< pixels for a field's frame and arrows

enum How : int { ByLonLat, ByPoints, ByHand };

/// File names; where two are alike, whole paths.
QStringList shortNames(const std::vector<PlaceableModel>& models) {
    QStringList names;
    for (const PlaceableModel& model : models)
        names << QFileInfo(model.path).fileName();
    const QStringList all = names;
    for (qsizetype k = 0; k < names.size(); ++k)
        if (all.count(all[k]) > 1)
            names[k] = models[std::size_t(k)].path;
    return names;
}

}  // namespace

PlaceDialog::PlaceDialog(std::vector<PlaceableModel> models, QWidget* parent)
    : QDialog(parent), m_known(std::move(models)) {
    setObjectName(QStringLiteral("placeDialog"));
    setWindowTitle(tr("Place a model"));
    m_models = new QComboBox;
    m_models->setObjectName(QStringLiteral("placeModel"));
    m_models->addItems(shortNames(m_known));
    for (int k = 0; k < m_models->count(); ++k)
        m_models->setItemData(k, m_known[std::size_t(k)].path, Qt::ToolTipRole);
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
    m_note = new QLabel;
    m_note->setObjectName(QStringLiteral("placeNote"));
    m_note->setWordWrap(true);
    m_note->setTextFormat(Qt::PlainText);

    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    m_place = buttons->button(QDialogButtonBox::Ok);
    m_place->setText(tr("&Place"));
    m_place->setObjectName(QStringLiteral("placeAccept"));
    connect(buttons, &QDialogButtonBox::accepted, this, &PlaceDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* form = new QFormLayout;
    form->addRow(tr("&Model"), m_models);
    form->addRow(tr("&How"), m_how);
    auto* column = new QVBoxLayout(this);
    column->addLayout(form);
    column->addWidget(m_pages, 1);
    column->addWidget(m_note);
    column->addWidget(buttons);

    connect(m_how, &QComboBox::currentIndexChanged, m_pages, &QStackedWidget::setCurrentIndex);
    connect(m_how, &QComboBox::currentIndexChanged, this, &PlaceDialog::check);
    connect(m_models, &QComboBox::currentIndexChanged, this, &PlaceDialog::showModel);
    showModel();
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
        box->setMinimumWidth(box->fontMetrics().horizontalAdvance(QStringLiteral("-00000000.000")) +
                             kBoxRoom);
        connect(box, &QDoubleSpinBox::valueChanged, this, &PlaceDialog::check);
        form->addRow(field.label, box);
        out.push_back(box);
    }
    m_how->addItem(title);
    m_pages->addWidget(page);
    return out;
}

void PlaceDialog::showModel() {
    const PlaceableModel& model = m_known[std::size_t(std::max(0, m_models->currentIndex()))];
    const ModelPlacement now = model.placement.value_or(ModelPlacement{});
    const double values[] = {now.offset.x, now.offset.y, now.offset.z, now.heading / kDegree};
    for (std::size_t k = 0; k < m_hand.size(); ++k)
        m_hand[k]->setValue(values[k]);
    m_hand.back()->setEnabled(!model.hasPlace);
    m_how->setEnabled(!model.hasPlace);
    if (model.hasPlace)
        m_how->setCurrentIndex(ByHand);
    check();
}

QString PlaceDialog::missing() const {
    const auto value = [](const QDoubleSpinBox* box) { return box->value(); };
    if (m_how->currentIndex() == ByLonLat)
        return value(m_earth[0]) == 0.0 && value(m_earth[1]) == 0.0
                   ? tr("Type the longitude and latitude of the model’s zero.")
                   : QString();
    if (m_how->currentIndex() != ByPoints)
        return {};
    const auto points = std::get<PlaceByPoints>(chosen().how);
    if (glm::distance(points.inModel[0], points.inModel[1]) < kNearest)
        return tr("Type two points of the model that are far apart.");
    if (glm::distance(points.onMap[0], points.onMap[1]) < kNearest)
        return tr("Type where both points lie on the map.");
    return {};
}

QString PlaceDialog::doubt() const {
    if (m_known[std::size_t(std::max(0, m_models->currentIndex()))].hasPlace)
        return tr("The file says itself where it lies, so it can be moved but not turned.");
    if (m_how->currentIndex() != ByPoints)
        return {};
    const auto points = std::get<PlaceByPoints>(chosen().how);
    const double inModel = glm::distance(points.inModel[0], points.inModel[1]);
    const double onMap = glm::distance(points.onMap[0], points.onMap[1]);
    if (std::abs(onMap / inModel - 1.0) <= kTolerableRatio)
        return {};
    return tr("The points are %1 m apart in the model and %2 m on the map. Check them, and whether "
              "the model is in metres.")
        .arg(inModel, 0, 'f', 2)
        .arg(onMap, 0, 'f', 2);
}

void PlaceDialog::check() {
    const QString lacks = missing();
    m_place->setEnabled(lacks.isEmpty() && !m_asked);
    m_note->setText(lacks.isEmpty() ? doubt() : lacks);
}

void PlaceDialog::accept() {
    if (m_asked || !missing().isEmpty())
        return;
    m_asked = true;
    check();
    Q_EMIT placeRequested(chosen());
}

void PlaceDialog::tell(const Error& error) {
    m_asked = false;
    check();
    const Message message = toMessage(error);
    m_note->setText(message.what + QLatin1Char('\n') + message.remedy);
}

PlaceRequest PlaceDialog::chosen() const {
    PlaceRequest request;
    request.model = m_known[std::size_t(std::max(0, m_models->currentIndex()))].path.toStdString();
    const int how = m_how->currentIndex();
    const Fields& fields = how == ByLonLat ? m_earth : how == ByPoints ? m_points : m_hand;
    const auto at = [&](std::size_t k) { return fields[k]->value(); };
    if (how == ByLonLat)
        request.how = PlaceByLonLat{at(0), at(1), at(2) * kDegree, at(3)};
    else if (how == ByPoints)
        request.how = PlaceByPoints{{glm::dvec2(at(0), at(1)), glm::dvec2(at(4), at(5))},
                                    {glm::dvec2(at(2), at(3)), glm::dvec2(at(6), at(7))},
                                    0.0};
    else
        request.how = PlaceByOffset{{at(0), at(1), at(2)}, at(3) * kDegree};
    return request;
}

}  // namespace reflet
