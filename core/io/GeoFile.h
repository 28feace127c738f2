// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/geo/ProjectFrame.h"
#include "core/heightfield/Heightfield.h"

namespace reflet {

/// Writes height layers as a GeoTIFF (float32, north up, AREA_OR_POINT=Area, NaN declared as
/// no-data, the frame's CRS) that GDAL and QGIS place correctly; heights in the project's datum.
/// layers: 1 = top_max, 2 = ground and top_max, 3 = ground, top_max and top_center; bands carry those names.
[[nodiscard]] Result<void> writeHeightfield(const Heightfield& field, const ProjectFrame& frame, int layers,
                                            const std::filesystem::path& path);

/// A line read from a vector file, in the CRS asked for.
struct GeoLine {
    std::string name;                 ///< attribute "name" or "id", else the feature id
    std::vector<glm::dvec3> points;   ///< absolute east, north, up; z = NaN where the file has none
};

/// All (multi)line strings of any vector file that GDAL opens, transformed into `frame`'s CRS.
/// A GeoJSON without a crs member is WGS 84 unless its coordinates are plainly outside ±180, ±90:
/// then they are taken to be in the project's CRS.
[[nodiscard]] Result<std::vector<GeoLine>> readLines(const std::filesystem::path& path, const ProjectFrame& frame);

[[nodiscard]] std::string gdalVersion();

}  // namespace reflet
