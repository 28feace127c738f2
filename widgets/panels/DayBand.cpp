// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/DayBand.h"

#include "core/math/Geometry.h"

#include <QLinearGradient>
#include <QPainter>
#include <algorithm>

namespace reflet {

namespace {

constexpr int kMinutesADay = 24 * 60;
constexpr double kCivilTwilight = -6.0 * kPi / 180.0;
constexpr double kFullDay = 6.0 * kPi / 180.0;  ///< from here on the band is as bright as it gets
/// The sun's upper edge touches the horizon (refraction is in the elevation already).
constexpr double kSunRadius = 0.2666 * kPi / 180.0;

double elevationAt(DateTime date, const GeoPosition& place, int minute) {
    date.hour = minute / 60;  // 24 is midnight of the next day, which the formulas take
    date.minute = minute % 60;
    date.second = 0.0;
    if (date.hour == 24) {
        date.hour = 23;
        date.minute = 59;
        date.second = 59.0;
    }
    return sunPosition(date, place.longitude, place.latitude).elevation;
}

QColor bandColor(double elevation) {
    const QColor night(36, 48, 84);
    const QColor dusk(200, 130, 92);
    const QColor noon(250, 226, 140);
    const auto mix = [](const QColor& a, const QColor& b, double t) {
        const double u = std::clamp(t, 0.0, 1.0);
        const auto channel = [u](int x, int y) { return int(x + u * (y - x)); };
        return QColor(channel(a.red(), b.red()), channel(a.green(), b.green()),
                      channel(a.blue(), b.blue()));
    };
    if (elevation < 0.0)
        return mix(night, dusk, 1.0 - elevation / kCivilTwilight);
    return mix(dusk, noon, elevation / kFullDay);
}

}  // namespace

Daylight daylightOf(const DateTime& date, const GeoPosition& place) {
    Daylight result;
    for (std::size_t i = 0; i < Daylight::kSamples; ++i)
        result.elevation[i] = elevationAt(date, place, int(i) * Daylight::kStep);
    const auto up = [](double elevation) { return elevation > -kSunRadius; };
    for (std::size_t i = 1; i < Daylight::kSamples; ++i) {
        const bool before = up(result.elevation[i - 1]);
        if (before == up(result.elevation[i]))
            continue;
        int minute = int(i - 1) * Daylight::kStep;
        while (up(elevationAt(date, place, minute)) == before)
            ++minute;
        (before ? result.sunset : result.sunrise) = std::min(minute, kMinutesADay - 1);
    }
    return result;
}

DayBand::DayBand(QWidget* parent) : QWidget(parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void DayBand::setDay(const std::optional<Daylight>& daylight, int minute) {
    m_daylight = daylight;
    m_minute = minute;
    update();
}

QSize DayBand::sizeHint() const {
    return {160, fontMetrics().height() + 10};
}

void DayBand::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF band(6.0, 0.0, width() - 12.0, 8.0);
    const auto x = [&](double minute) {
        return band.left() + band.width() * minute / kMinutesADay;
    };
    if (m_daylight) {
        QLinearGradient gradient(band.topLeft(), band.topRight());
        for (std::size_t i = 0; i < Daylight::kSamples; ++i)
            gradient.setColorAt(double(i) / double(Daylight::kSamples - 1),
                                bandColor(m_daylight->elevation[i]));
        painter.setBrush(gradient);
    } else {
        painter.setBrush(palette().color(QPalette::Mid));
    }
    painter.setPen(Qt::NoPen);
    painter.drawRoundedRect(band, 3.0, 3.0);

    QFont small = font();
    small.setPointSizeF(small.pointSizeF() * 0.85);
    painter.setFont(small);
    painter.setPen(palette().color(QPalette::WindowText));
    for (int hour = 0; hour <= 24; hour += 6) {
        const QString text = QString::number(hour);
        const double wide = painter.fontMetrics().horizontalAdvance(text);
        const double left = std::clamp(x(60.0 * hour) - wide / 2.0, 0.0, width() - wide);
        painter.drawText(QRectF(left, band.bottom(), wide + 1.0, height() - band.bottom()),
                         Qt::AlignLeft | Qt::AlignTop, text);
    }
    painter.setPen(QPen(palette().color(QPalette::WindowText), 2.0));
    painter.drawLine(QPointF(x(m_minute), 0.0), QPointF(x(m_minute), band.bottom() + 2.0));
}

}  // namespace reflet
