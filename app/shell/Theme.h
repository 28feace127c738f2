// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPalette>
#include <QString>

class QApplication;

namespace reflet {

/// How the window is coloured. System follows the desktop's palette as it was at the start.
enum class ThemeChoice { System, Light, Dark };

[[nodiscard]] QPalette lightPalette();
[[nodiscard]] QPalette darkPalette();

/// Gives the whole program Qt's Fusion style in one of the two palettes.
void applyTheme(QApplication& application, ThemeChoice choice);

/// The choice in the settings, and back.
[[nodiscard]] ThemeChoice savedTheme();
void saveTheme(ThemeChoice choice);

}  // namespace reflet
