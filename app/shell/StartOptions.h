// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <QStringList>
#include <optional>

namespace reflet {

/// What the program was asked for when it was started.
struct StartOptions {
    QStringList files;   ///< projects or city models, absolute paths
    QString samples;     ///< folder of the built-in samples; empty: the user's data folder
    QString screenshot;  ///< a PNG of the window is written here, then the program ends; empty = no
    double screenshotAfter = 3.0;           ///< seconds after the window was shown
    bool screenshotAtFirstPicture = false;  ///< instead: as soon as there is a picture of the city
    bool sayTimes = false;                  ///< how long the first picture took, on stderr
    bool rehearse = false;  ///< do a planner's work, say how the window bore it, end
};

/// Reads the command line, the program's name first. Text in place of options: to be printed, then
/// the program ends with 0 (--help, --version). Usage: an unknown option, a bad number.
struct ParsedStart {
    StartOptions options;
    std::optional<QString> text;
};
[[nodiscard]] Result<ParsedStart> parseStart(const QStringList& arguments);

/// Where the built-in samples lie or are written.
[[nodiscard]] QString sampleFolder(const StartOptions& options);
/// The project that the window shows first; empty when that is none that lies on the disk.
[[nodiscard]] QString firstProject(const StartOptions& options);

}  // namespace reflet
