// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/overlay/Hud.h"

#include "core/math/Geometry.h"
#include "widgets/viewport/overlay/Plates.h"

#include <QLocale>
#include <QPainter>
#include <QPainterPath>
#include <cmath>

namespace reflet {

namespace {

constexpr int kMargin = 12;
constexpr int kGap = 8;
constexpr int kCompassSize = 40;
constexpr int kScaleWidth = 132;
constexpr int kScaleHeight = 30;
constexpr double kLongestBar = 108.0;  // pixels
constexpr int kSmallestWidth = 360;    // of the parent, for the scale bar to have room

}  // namespace

double roundLength(double metres) {
    if (!(metres > 0.0) || !std::isfinite(metres)) {
        return 0.0;
    }
    const double power = std::pow(10.0, std::floor(std::log10(metres)));
    for (const double factor : {5.0, 2.0}) {
        if (factor * power <= metres) {
            return factor * power;
        }
    }
    return power;
}

Compass::Compass(QWidget* parent) : QAbstractButton(parent) {
    setObjectName(QStringLiteral("compass"));
    setAccessibleName(tr("Turn the view to the north"));
    setToolTip(tr("The arrow points north. Click to look there."));
    setCursor(Qt::PointingHandCursor);
    resize(sizeHint());
}

QSize Compass::sizeHint() const {
    return {kCompassSize, kCompassSize};
}

void Compass::setYaw(double yaw) {
    if (yaw != m_yaw && std::isfinite(yaw)) {
        m_yaw = yaw;
        update();
    }
}

void Compass::paintEvent(QPaintEvent* /*event*/) {
    const PlateColors colors(palette());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(hasFocus() ? QPen(palette().color(QPalette::Highlight), 2.0) : Qt::NoPen);
    painter.setBrush(colors.ground);
    painter.drawEllipse(QRectF(rect()).adjusted(1.0, 1.0, -1.0, -1.0));
    painter.translate(0.5 * width(), 0.5 * height());
    // Looking north the arrow stands upright; looking east (yaw 0) north is on the left.
    painter.rotate((m_yaw - 0.5 * kPi) * 180.0 / kPi);
    const double tip = 0.38 * kCompassSize, half = 0.12 * kCompassSize;
    QPainterPath north;
    north.moveTo(0.0, -tip);
    north.lineTo(half, 0.0);
    north.lineTo(-half, 0.0);
    north.closeSubpath();
    painter.fillPath(north, QColor(206, 58, 46));
    QPainterPath south;
    south.moveTo(0.0, tip);
    south.lineTo(half, 0.0);
    south.lineTo(-half, 0.0);
    south.closeSubpath();
    QColor pale = colors.text;
    pale.setAlpha(120);
    painter.fillPath(south, pale);
}

ScaleBar::ScaleBar(QWidget* parent) : QWidget(parent) {
    setObjectName(QStringLiteral("scaleBar"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAccessibleName(tr("Scale"));
    resize(sizeHint());
}

QSize ScaleBar::sizeHint() const {
    return {kScaleWidth, kScaleHeight};
}

void ScaleBar::setMetresPerPixel(double metres) {
    m_metresPerPixel = std::isfinite(metres) ? metres : 0.0;
    m_length = roundLength(kLongestBar * m_metresPerPixel);
    setAccessibleDescription(text());
    update();
}

QString ScaleBar::text() const {
    const QLocale locale;
    if (m_length >= 1000.0) {
        return tr("%1 km").arg(locale.toString(m_length / 1000.0, 'g', 4));
    }
    if (m_length >= 1.0) {
        return tr("%1 m").arg(locale.toString(m_length, 'g', 4));
    }
    return tr("%1 cm").arg(locale.toString(m_length * 100.0, 'g', 4));
}

void ScaleBar::paintEvent(QPaintEvent* /*event*/) {
    if (!(m_length > 0.0)) {
        return;
    }
    const PlateColors colors(palette());
    QPainter painter(this);
    paintPlate(painter, rect(), colors);
    const double pixels = m_length / m_metresPerPixel;
    const double x = 0.5 * (width() - pixels), y = height() - 8.0, tick = 4.0;
    painter.setPen(QPen(colors.text, 1.5));
    painter.drawPolyline(
        QPolygonF({{x, y - tick}, {x, y}, {x + pixels, y}, {x + pixels, y - tick}}));
    QFont small = font();
    small.setPointSizeF(0.85 * small.pointSizeF());
    painter.setFont(small);
    painter.drawText(QRectF(0.0, 1.0, width(), height() - 10.0), Qt::AlignCenter, text());
}

Hud::Hud(QWidget* parent)
    : QObject(parent),
      m_parent(parent),
      m_caption(makePlate(parent)),
      m_scale(new ScaleBar(parent)),
      m_compass(new Compass(parent)) {
    m_caption->setObjectName(QStringLiteral("viewportCaption"));
    connect(m_compass, &Compass::clicked, this, &Hud::northWanted);
    layOut();
}

void Hud::setShown(bool shown) {
    m_shown = shown;
    layOut();
}

void Hud::setCaption(const QString& text) {
    if (text != m_caption->text()) {
        m_caption->setText(text);
        layOut();
    }
}

void Hud::setView(double yaw, double metresPerPixel) {
    m_compass->setYaw(yaw);
    m_scale->setMetresPerPixel(metresPerPixel);
}

void Hud::layOut() {
    const int width = m_parent->width(), height = m_parent->height();
    m_caption->setVisible(m_shown && !m_caption->text().isEmpty());
    m_caption->adjustSize();
    m_caption->move(kMargin, height - kMargin - m_caption->height());
    m_compass->setVisible(m_shown);
    m_compass->move(width - kMargin - m_compass->width(), height - kMargin - m_compass->height());
    m_scale->setVisible(m_shown && width >= kSmallestWidth);
    m_scale->move(m_compass->x() - kGap - m_scale->width(), height - kMargin - m_scale->height());
}

}  // namespace reflet
