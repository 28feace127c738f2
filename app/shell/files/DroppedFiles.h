// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>

namespace reflet {

/// Files and folders by what they are to Reflet, absolute paths. Of a folder, the project in it is
/// taken, or else the city models that lie in it directly.
struct DroppedFiles {
    QStringList projects, cities, vehicles, unknown;
};

/// By the name alone: whether a .json is a city is seen when it is read.
[[nodiscard]] DroppedFiles sortDropped(const QStringList& paths);

}  // namespace reflet
