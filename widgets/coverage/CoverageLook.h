// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QPointF>
#include <QString>

class QPainter;

namespace reflet {

/// "83.4 %" with the locale's digits; share: 0..1.
[[nodiscard]] QString percentText(double share, int decimals = 1);
/// "+4.1 %", "−0.2 %".
[[nodiscard]] QString gainText(double share);
/// coverageColor() for painters.
[[nodiscard]] QColor coverageTone(double coverage);
[[nodiscard]] QColor ghostTone();
/// A broken ring around a dot: a probe that is suggested and does not exist yet. `radius` in
/// logical pixels.
void paintGhostMark(QPainter& painter, const QPointF& center, double radius);

}  // namespace reflet
