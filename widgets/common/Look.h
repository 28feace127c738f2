// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/gpu/Frame.h"

#include <QColor>
#include <QIcon>
#include <QPalette>
#include <QPointF>
#include <QString>

class QPainter;

// Colours of data and the words for them, the same in every panel. The colours are those of Okabe
// and Ito (2008), which people with any kind of colour vision tell apart; each also has a shape.

namespace reflet {

namespace DataColor {
inline constexpr QRgb kBlue = 0xFF0072B2;
inline constexpr QRgb kSky = 0xFF56B4E9;
inline constexpr QRgb kGreen = 0xFF009E73;
inline constexpr QRgb kYellow = 0xFFF0E442;
inline constexpr QRgb kOrange = 0xFFE69F00;
inline constexpr QRgb kVermilion = 0xFFD55E00;
inline constexpr QRgb kPurple = 0xFFCC79A7;
inline constexpr QRgb kGrey = 0xFF8A8A8A;
}  // namespace DataColor

[[nodiscard]] QColor probeColor(ProbeState state);
/// "baked", "out of date" ...
[[nodiscard]] QString probeStateText(ProbeState state);
/// What the state means and what to do, in a planner's words.
[[nodiscard]] QString probeStateHelp(ProbeState state);
/// The mark of a probe: disc baked, triangle out of date, ring never baked, disc with a gap baking,
/// cross refused. `radius` in logical pixels.
void paintProbeMark(QPainter& painter, const QPointF& center, double radius, ProbeState state);
[[nodiscard]] QIcon probeIcon(ProbeState state);

/// Words for a method, as planners read them.
[[nodiscard]] QString methodText(Method method);
[[nodiscard]] QString methodHelp(Method method);

[[nodiscard]] QIcon severityIcon(Severity severity);
[[nodiscard]] QString severityText(Severity severity);

/// True when the palette shows light text on a dark ground.
[[nodiscard]] bool isDark(const QPalette& palette);
/// Text that is less important than the rest, legible on the window's ground.
[[nodiscard]] QColor mutedText(const QPalette& palette);

/// "12.30 m" with the locale's digits.
[[nodiscard]] QString metresText(double metres, int decimals);

}  // namespace reflet
