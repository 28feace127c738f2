// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/Theme.h"

#include <QApplication>
#include <QSettings>
#include <QStyleFactory>

namespace reflet {
namespace {

constexpr int kHalfLightness = 128;
const char* const kThemeKey = "window/theme";

/// The few colours of which a palette is made.
struct Shades {
    QColor window, base, alternate, button, text, faint, border, accent, accentText, link;
};

QPalette paletteOf(const Shades& shades) {
    QPalette palette;
    palette.setColor(QPalette::Window, shades.window);
    palette.setColor(QPalette::WindowText, shades.text);
    palette.setColor(QPalette::Base, shades.base);
    palette.setColor(QPalette::AlternateBase, shades.alternate);
    palette.setColor(QPalette::ToolTipBase, shades.base);
    palette.setColor(QPalette::ToolTipText, shades.text);
    palette.setColor(QPalette::PlaceholderText, shades.faint);
    palette.setColor(QPalette::Text, shades.text);
    palette.setColor(QPalette::Button, shades.button);
    palette.setColor(QPalette::ButtonText, shades.text);
    palette.setColor(QPalette::BrightText, Qt::white);
    palette.setColor(QPalette::Highlight, shades.accent);
    palette.setColor(QPalette::HighlightedText, shades.accentText);
    palette.setColor(QPalette::Link, shades.link);
    palette.setColor(QPalette::LinkVisited, shades.link);
    palette.setColor(QPalette::Light, shades.button.lighter(115));
    palette.setColor(QPalette::Midlight, shades.button.lighter(107));
    palette.setColor(QPalette::Mid, shades.border);
    palette.setColor(QPalette::Dark, shades.border.darker(115));
    palette.setColor(QPalette::Shadow, Qt::black);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
        palette.setColor(QPalette::Disabled, role, shades.faint);
    }
    palette.setColor(QPalette::Disabled, QPalette::Highlight, shades.border);
    return palette;
}

/// The desktop's own palette, before Reflet sets one.
bool desktopIsDark() {
    static const bool dark =
        QApplication::palette().color(QPalette::Window).lightness() < kHalfLightness;
    return dark;
}

}  // namespace

QPalette lightPalette() {
    return paletteOf({.window = QColor(0xf3f4f4),
                      .base = QColor(0xffffff),
                      .alternate = QColor(0xf0f3f3),
                      .button = QColor(0xf8f9f9),
                      .text = QColor(0x1d2528),
                      .faint = QColor(0x7d888c),
                      .border = QColor(0xc5cccf),
                      .accent = QColor(0x14737b),
                      .accentText = QColor(0xffffff),
                      .link = QColor(0x0f6a8c)});
}

QPalette darkPalette() {
    return paletteOf({.window = QColor(0x23282a),
                      .base = QColor(0x1a1e20),
                      .alternate = QColor(0x202527),
                      .button = QColor(0x2c3235),
                      .text = QColor(0xe6eaeb),
                      .faint = QColor(0x859095),
                      .border = QColor(0x434b4f),
                      .accent = QColor(0x2a9aa3),
                      .accentText = QColor(0xffffff),
                      .link = QColor(0x6cc3dc)});
}

void applyTheme(QApplication& application, ThemeChoice choice) {
    const bool dark =
        choice == ThemeChoice::Dark || (choice == ThemeChoice::System && desktopIsDark());
    application.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    application.setPalette(dark ? darkPalette() : lightPalette());
}

ThemeChoice savedTheme() {
    const QString name = QSettings().value(QLatin1String(kThemeKey)).toString();
    if (name == QLatin1String("light")) {
        return ThemeChoice::Light;
    }
    return name == QLatin1String("dark") ? ThemeChoice::Dark : ThemeChoice::System;
}

void saveTheme(ThemeChoice choice) {
    const char* name = "system";
    if (choice != ThemeChoice::System) {
        name = choice == ThemeChoice::Dark ? "dark" : "light";
    }
    QSettings().setValue(QLatin1String(kThemeKey), QLatin1String(name));
}

}  // namespace reflet
