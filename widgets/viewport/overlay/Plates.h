// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QLabel>

QT_BEGIN_NAMESPACE
class QPainter;
class QRectF;
QT_END_NAMESPACE

namespace reflet {

/// Colours of what lies over the picture: half-transparent window colours, readable on any picture
/// and at home in light and dark themes.
struct PlateColors {
    QColor ground, text;
    explicit PlateColors(const QPalette& palette);
};

/// A small text over the picture on a rounded ground. It lets the mouse through.
[[nodiscard]] QLabel* makePlate(QWidget* parent);
void paintPlate(QPainter& painter, const QRectF& area, const PlateColors& colors);

}  // namespace reflet
