// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/SunPanel.h"

#include "core/math/Geometry.h"
#include "widgets/common/DragSlider.h"
#include "widgets/common/Look.h"
#include "widgets/common/NumberEdit.h"
#include "widgets/panels/DayBand.h"

#include <QDate>
#include <QDateEdit>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QSignalBlocker>
#include <QTimeEdit>
#include <QVBoxLayout>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr int kMinutesADay = 24 * 60;
constexpr double kLeastTurbidity = 2.0;
constexpr double kMostTurbidity = 10.0;
constexpr double kTurbiditySteps = 10.0;  ///< slider steps a unit
constexpr double kMostStops = 6.0;        ///< photographic stops up and down
constexpr double kStopSteps = 20.0;       ///< slider steps a stop

double degrees(double radians) {
    return radians * 180.0 / kPi;
}

QString compass(double azimuth) {
    const std::array<QString, 8> names{SunPanel::tr("north"), SunPanel::tr("north-east"),
                                       SunPanel::tr("east"),  SunPanel::tr("south-east"),
                                       SunPanel::tr("south"), SunPanel::tr("south-west"),
                                       SunPanel::tr("west"),  SunPanel::tr("north-west")};
    const auto index = std::lround(degrees(azimuth) / 45.0);
    return names[std::size_t((index % 8 + 8) % 8)];
}

QString clockText(int minute) {
    return QTime(0, 0).addSecs(60 * minute).toString(QStringLiteral("HH:mm"));
}

}  // namespace

struct SunPanel::Impl {
    explicit Impl(SunPanel* owner) : panel(owner) {}

    SunPanel* panel;
    DateTime date;
    std::optional<GeoPosition> place;
    DayBand* band = nullptr;
    DragSlider* day = nullptr;
    DragSlider* year = nullptr;
    QDateEdit* dateEdit = nullptr;
    QTimeEdit* timeEdit = nullptr;
    NumberEdit* offset = nullptr;
    QLabel* sun = nullptr;
    QLabel* rise = nullptr;
    DragSlider* haze = nullptr;
    NumberEdit* hazeEdit = nullptr;
    DragSlider* exposure = nullptr;
    NumberEdit* exposureEdit = nullptr;

    [[nodiscard]] QDate calendar() const { return {date.year, date.month, date.day}; }
    [[nodiscard]] int minute() const { return 60 * date.hour + date.minute; }
    void setMinute(int minute) {
        date.hour = std::min(minute, kMinutesADay - 1) / 60;
        date.minute = std::min(minute, kMinutesADay - 1) % 60;
        date.second = 0.0;
    }
    void setCalendar(const QDate& value) {
        date.year = value.year();
        date.month = value.month();
        date.day = value.day();
    }
    void report(DragPhase phase) {
        showDate();
        Q_EMIT panel->dateChanged(date, phase);
    }
    void build();
    void connectAll();
    void showDate();
    void showSun();
};

void SunPanel::Impl::build() {
    band = new DayBand(panel);
    day = new DragSlider(panel);
    day->setObjectName(QStringLiteral("daySlider"));
    day->setRange(0, kMinutesADay - 1);
    day->setSingleStep(5);
    day->setPageStep(60);
    day->setAccessibleName(tr("Time of day"));
    day->setToolTip(tr("Time of day; the band above shows when the sun is up"));
    year = new DragSlider(panel);
    year->setObjectName(QStringLiteral("yearSlider"));
    year->setPageStep(30);
    year->setAccessibleName(tr("Day of the year"));
    year->setToolTip(tr("Day of the year"));
    dateEdit = new QDateEdit(panel);
    dateEdit->setObjectName(QStringLiteral("dateEdit"));
    dateEdit->setCalendarPopup(true);
    dateEdit->setKeyboardTracking(false);
    dateEdit->setToolTip(tr("The date of the light"));
    timeEdit = new QTimeEdit(panel);
    timeEdit->setObjectName(QStringLiteral("timeEdit"));
    timeEdit->setKeyboardTracking(false);
    timeEdit->setDisplayFormat(QStringLiteral("HH:mm"));
    timeEdit->setToolTip(tr("The local time of the light"));
    offset = new NumberEdit(panel);
    offset->setObjectName(QStringLiteral("utcOffset"));
    offset->setRange(-12.0, 14.0);
    offset->setDecimals(2);
    offset->setSingleStep(0.5);
    offset->setSuffix(tr(" h"));
    offset->setToolTip(
        tr("How far local time is ahead of UTC; 2 h is summer time in central Europe"));
    sun = new QLabel(panel);
    sun->setObjectName(QStringLiteral("sunReadout"));
    rise = new QLabel(panel);
    for (QLabel* label : {sun, rise})
        label->setWordWrap(true);
    haze = new DragSlider(panel);
    haze->setObjectName(QStringLiteral("hazeSlider"));
    haze->setRange(int(kLeastTurbidity * kTurbiditySteps), int(kMostTurbidity * kTurbiditySteps));
    haze->setAccessibleName(tr("Haze"));
    haze->setToolTip(tr("Haze of the sky: 2 is very clear, 10 is milky (turbidity)"));
    hazeEdit = new NumberEdit(panel);
    hazeEdit->setRange(kLeastTurbidity, kMostTurbidity);
    hazeEdit->setDecimals(1);
    hazeEdit->setSingleStep(0.1);
    hazeEdit->setToolTip(haze->toolTip());
    exposure = new DragSlider(panel);
    exposure->setObjectName(QStringLiteral("exposureSlider"));
    exposure->setRange(int(-kMostStops * kStopSteps), int(kMostStops * kStopSteps));
    exposure->setAccessibleName(tr("Exposure"));
    exposure->setToolTip(tr("Brightness of the picture in photographic stops; changes no light"));
    exposureEdit = new NumberEdit(panel);
    exposureEdit->setRange(-kMostStops, kMostStops);
    exposureEdit->setDecimals(2);
    exposureEdit->setSingleStep(0.1);
    exposureEdit->setSuffix(tr(" EV"));
    exposureEdit->setToolTip(exposure->toolTip());

    auto* layout = new QFormLayout(panel);
    layout->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    layout->setRowWrapPolicy(QFormLayout::WrapLongRows);
    const auto row = [&](const QString& name, std::initializer_list<QWidget*> widgets) {
        auto* line = new QHBoxLayout;
        for (QWidget* widget : widgets)
            line->addWidget(widget, qobject_cast<DragSlider*>(widget) ? 1 : 0);
        auto* label = new QLabel(name, panel);
        label->setBuddy(*widgets.begin());
        layout->addRow(label, line);
    };
    row(tr("&Date"), {dateEdit, timeEdit});
    row(tr("&UTC +"), {offset});
    auto* dayColumn = new QVBoxLayout;
    dayColumn->setSpacing(0);
    dayColumn->addWidget(band);
    dayColumn->addWidget(day);
    auto* dayLabel = new QLabel(tr("D&ay"), panel);
    dayLabel->setBuddy(day);
    layout->addRow(dayLabel, dayColumn);
    row(tr("&Year"), {year});
    layout->addRow(tr("Sun"), sun);
    layout->addRow(QString(), rise);
    row(tr("&Haze"), {haze, hazeEdit});
    row(tr("E&xposure"), {exposure, exposureEdit});
}

void SunPanel::Impl::connectAll() {
    QObject::connect(day, &DragSlider::moved, panel, [this](int value, DragPhase phase) {
        setMinute(value);
        report(phase);
    });
    QObject::connect(year, &DragSlider::moved, panel, [this](int value, DragPhase phase) {
        setCalendar(QDate(date.year, 1, 1).addDays(value - 1));
        report(phase);
    });
    QObject::connect(dateEdit, &QDateEdit::dateChanged, panel, [this](const QDate& value) {
        setCalendar(value);
        report(DragPhase::End);
    });
    QObject::connect(timeEdit, &QTimeEdit::timeChanged, panel, [this](const QTime& value) {
        setMinute(60 * value.hour() + value.minute());
        report(DragPhase::End);
    });
    QObject::connect(offset, &NumberEdit::edited, panel, [this](double value, DragPhase phase) {
        date.utcOffsetHours = value;
        report(phase);
    });
    QObject::connect(haze, &DragSlider::moved, panel, [this](int value, DragPhase phase) {
        hazeEdit->show(value / kTurbiditySteps);
        Q_EMIT panel->turbidityChanged(float(value / kTurbiditySteps), phase);
    });
    QObject::connect(hazeEdit, &NumberEdit::edited, panel, [this](double value, DragPhase phase) {
        haze->show(int(std::lround(value * kTurbiditySteps)));
        Q_EMIT panel->turbidityChanged(float(value), phase);
    });
    QObject::connect(exposure, &DragSlider::moved, panel, [this](int value, DragPhase phase) {
        exposureEdit->show(value / kStopSteps);
        Q_EMIT panel->exposureChanged(float(std::exp2(value / kStopSteps)), phase);
    });
    QObject::connect(exposureEdit, &NumberEdit::edited, panel,
                     [this](double value, DragPhase phase) {
                         exposure->show(int(std::lround(value * kStopSteps)));
                         Q_EMIT panel->exposureChanged(float(std::exp2(value)), phase);
                     });
}

void SunPanel::Impl::showDate() {
    const QSignalBlocker quietDate(dateEdit);
    const QSignalBlocker quietTime(timeEdit);
    const QSignalBlocker quietYear(year);
    dateEdit->setDate(calendar());
    timeEdit->setTime(QTime(date.hour, date.minute));
    offset->show(date.utcOffsetHours);
    day->show(minute());
    if (!year->dragging())
        year->setRange(1, calendar().daysInYear());
    year->show(calendar().dayOfYear());
    showSun();
}

void SunPanel::Impl::showSun() {
    if (!place) {
        band->setDay(std::nullopt, minute());
        sun->setText(tr("The city has local coordinates: its place on Earth is not known."));
        rise->clear();
        return;
    }
    const SunPosition position = sunPosition(date, place->longitude, place->latitude);
    const double elevation = degrees(position.elevation);
    const QLocale locale;
    sun->setText(elevation < 0.0
                     ? tr("%1° below the horizon").arg(locale.toString(-elevation, 'f', 1))
                     : tr("%1° high in the %2 (%3°)")
                           .arg(locale.toString(elevation, 'f', 1), compass(position.azimuth),
                                locale.toString(degrees(position.azimuth), 'f', 0)));
    const Daylight light = daylightOf(date, *place);
    band->setDay(light, minute());
    if (light.sunrise && light.sunset)
        rise->setText(
            tr("Up from %1 to %2").arg(clockText(*light.sunrise), clockText(*light.sunset)));
    else
        rise->setText(light.elevation[kMinutesADay / 2 / Daylight::kStep] > 0.0
                          ? tr("The sun does not set on this day.")
                          : tr("The sun does not rise on this day."));
}

SunPanel::SunPanel(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>(this)) {
    setAccessibleName(tr("Sun and light"));
    m_impl->build();
    m_impl->showDate();
    setTurbidity(2.5F);
    setExposure(1.0F);
    m_impl->connectAll();
}

SunPanel::~SunPanel() = default;

void SunPanel::setDate(const DateTime& date) {
    if (m_impl->day->dragging() || m_impl->year->dragging())
        return;
    m_impl->date = date;
    m_impl->showDate();
}

void SunPanel::setPlace(std::optional<GeoPosition> place) {
    m_impl->place = place;
    m_impl->showDate();
}

void SunPanel::setTurbidity(float turbidity) {
    m_impl->haze->show(int(std::lround(turbidity * kTurbiditySteps)));
    m_impl->hazeEdit->show(double(turbidity));
}

void SunPanel::setExposure(float exposure) {
    const double stops = std::log2(std::max(double(exposure), 1e-6));
    m_impl->exposure->show(int(std::lround(stops * kStopSteps)));
    m_impl->exposureEdit->show(stops);
}

}  // namespace reflet
