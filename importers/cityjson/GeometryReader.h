// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/cityjson/CityJsonFile.h"
#include "importers/common/CityGeometry.h"
#include "importers/common/ImportReport.h"

#include <vector>

namespace reflet::cityjson {

/// Reads the chosen geometries in one walk. What is unusable is left out and noted in the report.
[[nodiscard]] Result<CityGeometry> readCityGeometry(JsonDocument& document, const SourceCity& file,
                                                    const std::vector<bool>& chosen,
                                                    ImportReport& report, const JobContext& job);

}  // namespace reflet::cityjson
