// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"
#include "core/heightfield/Heightfield.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace reflet {

/// Writes height layers as a GeoTIFF (float32, north up, AREA_OR_POINT=Area, NaN declared as
/// no-data, the frame's CRS) that GDAL and QGIS place correctly; heights in the project's datum.
/// Heights are absolute, rows run from north to south; a local frame writes its place but no CRS,
/// and a frame whose vertical datum is known the compound one. Written atomically.
/// layers: 1 = top_max; 2 = ground, top_max, and what hangs over the ground: ceil_min (its lowest
/// underside) and over_top (where that solid ends), no-data where nothing does; 3 = ground,
/// top_max, top_center, ceil_min, over_top, base_top (where what stands on the ground ends) and
/// low_3, high_3, low_4 ... of further stretches, as many as a column of the field has, 16 at most.
/// Bands carry those names.
[[nodiscard]] Result<void> writeHeightfield(const Heightfield& field, const ProjectFrame& frame,
                                            int layers, const std::filesystem::path& path);

/// A line read from a vector file, in the CRS asked for.
struct GeoLine {
    std::string name;                ///< attribute "name" or "id", else the feature id
    std::vector<glm::dvec3> points;  ///< absolute east, north, up; z = NaN where the file has none
    /// Of the feature, as text; those without a value are left out.
    std::map<std::string, std::string> attributes = {};
};

/// All (multi)line strings of a vector file (GeoJSON, GeoPackage, shapefile, FlatGeobuf, KML, GPX,
/// DXF, OSM and others whose data lie in the file itself), brought into `frame`'s CRS, never by a
/// ballpark transformation; east first whatever the CRS's own order. Further parts of a multi-line
/// are named "name (2)" and so on; lines of less than two points or with a coordinate that is not
/// finite are left out.
///
/// A layer without a CRS is in the project's. A GeoJSON without a crs member is WGS 84 unless its
/// coordinates are plainly outside ±180, ±90, or the project has local coordinates: then they are
/// taken to be the project's.
///
/// Unreadable when there is no such file, GDAL cannot open it, or it holds no line; Refused for a
/// CRS that cannot be brought into the project's; ResourceLimit above 512 MB or a million points.
[[nodiscard]] Result<std::vector<GeoLine>> readLines(const std::filesystem::path& path,
                                                     const ProjectFrame& frame);

[[nodiscard]] std::string gdalVersion();

}  // namespace reflet
