// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/cityjson/JsonDocument.h"
#include "importers/common/SourceCity.h"

#include <string>

namespace reflet::cityjson {

using namespace importers;

/// Reads it in one walk. Unreadable, with the place and a remedy, for what is no CityJSON 1.0, 1.1
/// or 2.0; Cancelled.
[[nodiscard]] Result<SourceCity> readCityJsonFile(JsonDocument& document,
                                                  const std::string& subject,
                                                  const JobContext& job);

/// The first line of a CityJSON text sequence: a city without objects.
[[nodiscard]] Result<SourceCity> readSequenceHeader(JsonDocument& document,
                                                    const std::string& subject,
                                                    const JobContext& job);
/// A CityJSONFeature of the sequence: its own objects, vertices and appearance; version, transform
/// (unless it has one of its own), levels and outlines of templates are the header's.
[[nodiscard]] Result<SourceCity> readSequenceFeature(JsonDocument& document,
                                                     const SourceCity& header,
                                                     const std::string& subject,
                                                     const JobContext& job);

}  // namespace reflet::cityjson
