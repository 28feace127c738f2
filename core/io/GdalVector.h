// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <ogrsf_frmts.h>

#include <filesystem>
#include <memory>
#include <string>

// What the readers of vector files share. Only for the .cpp files of core/io, beside GdalSession.h.
namespace reflet {

class GdalSession;
struct GdalClose;
using GdalDataset = std::unique_ptr<GDALDataset, GdalClose>;

namespace gdal {

/// Whether the first coordinate of a layer's data is the north one. OGR's drivers put east first,
/// nearly all, and say so by the mapping of their axes to those of the CRS.
[[nodiscard]] bool northFirst(const OGRSpatialReference& system);

[[nodiscard]] bool isGeoJson(GDALDataset& dataset);

/// "GDAL cannot read it", with its reason if it has given one.
[[nodiscard]] std::string whyNot(const GdalSession& session);

/// WKT2:2019; empty when GDAL cannot write it.
[[nodiscard]] std::string wktOf(const OGRSpatialReference& system);

/// Opens a vector file with one of the drivers (ends with nullptr), read-only. The session stays
/// the caller's. Unreadable when there is no such file or none of the drivers takes it.
[[nodiscard]] Result<GdalDataset> openVector(const std::filesystem::path& path,
                                             const char* const* drivers,
                                             const GdalSession& session);

}  // namespace gdal
}  // namespace reflet
