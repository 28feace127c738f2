// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/coverage/CoverageLook.h"

#include "core/gpu/overlay/CoverageOverlay.h"

#include <QCoreApplication>
#include <QLocale>
#include <QPainter>
#include <cmath>

namespace reflet {

namespace {

struct Words {
    Q_DECLARE_TR_FUNCTIONS(reflet::CoveragePanel)
};

QColor toColor(const glm::vec3& color) {
    return QColor::fromRgbF(color.x, color.y, color.z);
}

}  // namespace

QString percentText(double share, int decimals) {
    return Words::tr("%1 %").arg(QLocale().toString(100.0 * share, 'f', decimals));
}

QString gainText(double share) {
    const QString sign = share < 0.0 ? QStringLiteral("−") : QStringLiteral("+");
    return sign + percentText(std::abs(share));
}

QColor coverageTone(double coverage) {
    return toColor(coverageColor(coverage));
}

QColor ghostTone() {
    return toColor(kGhostColor);
}

void paintGhostMark(QPainter& painter, const QPointF& center, double radius) {
    const QColor dark(20, 24, 28);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(dark, 0.22 * radius + 2.2, Qt::SolidLine, Qt::FlatCap));
    painter.drawEllipse(center, radius, radius);
    QPen ring(ghostTone(), 0.22 * radius + 0.4, Qt::CustomDashLine, Qt::FlatCap);
    ring.setDashPattern({1.7, 1.0});
    painter.setPen(ring);
    painter.drawEllipse(center, radius, radius);
    painter.setPen(QPen(dark, 1.2));
    painter.setBrush(ghostTone());
    painter.drawEllipse(center, 0.42 * radius, 0.42 * radius);
}

}  // namespace reflet
