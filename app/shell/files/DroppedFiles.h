// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"

#include <QStringList>
#include <vector>

namespace reflet {

/// Files and folders by what they are to Reflet, absolute paths. Of a folder, the project in it is
/// taken, or else the city models that cityFilesIn() finds, or else the vehicles that lie in it.
struct DroppedFiles {
    QStringList projects, cities, vehicles, unknown;
    QStringList unclear;              ///< glTF files that may be a city or a vehicle
    std::vector<Diagnostic> remarks;  ///< what of a folder was passed over
};

/// By the name; a glTF file by its description (guessGltf), and a file of an unknown suffix is
/// asked for its content.
[[nodiscard]] DroppedFiles sortDropped(const QStringList& paths);

/// "*.json *.gml": the files of all formats of city models, for a file dialog.
[[nodiscard]] QString cityPatterns();
/// "CityJSON, CityGML": for a message.
[[nodiscard]] QString cityFormatNames();

}  // namespace reflet
