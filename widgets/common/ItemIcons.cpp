// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/ItemIcons.h"

#include "widgets/common/Look.h"

#include <QPainter>
#include <QPixmap>

namespace reflet {

namespace {

constexpr int kSize = 16;
const QColor kInk(118, 128, 140);  ///< 3:1 and more on white and on near black

void paintSign(QPainter& painter, ProjectItem::Kind kind) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(kInk);
    switch (kind) {
        case ProjectItem::Kind::Model:  // three houses of different heights
            painter.drawRect(QRectF(1.0, 7.0, 4.0, 8.0));
            painter.drawRect(QRectF(6.0, 2.0, 4.5, 13.0));
            painter.drawRect(QRectF(11.5, 9.0, 3.5, 6.0));
            break;
        case ProjectItem::Kind::Route:
            painter.setBrush(Qt::NoBrush);
            painter.setPen(
                QPen(QColor(30, 136, 200), 2.4, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
            painter.drawPolyline(QPolygonF({{2.0, 13.0}, {6.0, 6.0}, {10.0, 9.5}, {14.0, 3.0}}));
            break;
        case ProjectItem::Kind::Reflector:
        case ProjectItem::Kind::Vehicle: {
            const bool onRoute = kind == ProjectItem::Kind::Reflector;
            painter.setBrush(onRoute ? QColor(DataColor::kOrange) : kInk);
            painter.drawRoundedRect(QRectF(1.0, 4.0, 14.0, 7.5), 2.0, 2.0);
            painter.setBrush(QColor(255, 255, 255, 220));
            painter.drawRect(QRectF(3.0, 5.5, 4.0, 3.0));
            painter.drawRect(QRectF(8.5, 5.5, 4.5, 3.0));
            painter.setBrush(kInk.darker(140));
            painter.drawEllipse(QPointF(4.5, 12.0), 2.0, 2.0);
            painter.drawEllipse(QPointF(11.5, 12.0), 2.0, 2.0);
            break;
        }
        case ProjectItem::Kind::View:
            painter.drawRoundedRect(QRectF(1.0, 4.5, 10.0, 8.0), 1.5, 1.5);
            painter.drawPolygon(QPolygonF({{11.0, 8.5}, {15.0, 5.0}, {15.0, 12.0}}));
            break;
        case ProjectItem::Kind::Probe:
            paintProbeMark(painter, {8.0, 8.0}, 6.5, ProbeState::Fresh);
            break;
    }
}

}  // namespace

QIcon itemIcon(ProjectItem::Kind kind) {
    QIcon icon;
    for (const int ratio : {1, 2, 3}) {
        QPixmap pixmap(kSize * ratio, kSize * ratio);
        pixmap.setDevicePixelRatio(ratio);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        painter.setRenderHint(QPainter::Antialiasing);
        paintSign(painter, kind);
        icon.addPixmap(pixmap);
    }
    return icon;
}

}  // namespace reflet
