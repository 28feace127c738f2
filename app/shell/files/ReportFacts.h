// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/LoadedCity.h"
#include "widgets/panels/ReportPanel.h"

#include <QString>
#include <string>
#include <vector>

namespace reflet {

// What was read of a city's files, in the user's words.

/// "1,204 objects were read: 3 were mended, 1 was left out."
[[nodiscard]] QString reportSummary(const LoadedCity& city);
[[nodiscard]] std::vector<FileRemark> reportRemarks(const LoadedCity& city);
[[nodiscard]] std::vector<FileFacts> reportFacts(const LoadedCity& city);
/// Whether anything was mended, left out or warned of.
[[nodiscard]] bool isWorthTelling(const LoadedCity& city);

/// Around an object of one of the files of that name, and around all that is part of it, in the
/// frame; empty when it shows nothing.
[[nodiscard]] Box boxOfObject(const LoadedCity& city, const QString& fileName,
                              const std::string& object);

}  // namespace reflet
