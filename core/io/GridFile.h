// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"
#include "core/heightfield/Heightfield.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace reflet {

/// A layer of numbers over the cells of a grid.
struct GridBand {
    std::string name;
    std::string unit;                                 ///< as GDAL writes it: "metre"; may be empty
    std::function<double(std::size_t cell)> valueAt;  ///< by GridSpec::index; NaN = no data
};

/// What a raster is about, for the file's metadata.
struct GridDescription {
    bool heights = false;  ///< the bands hold heights: the CRS names their datum too
    std::map<std::string, std::string> metadata;
};

/// Writes layers over a grid as a GeoTIFF (float32, north up, AREA_OR_POINT=Area, NaN declared as
/// no-data, the frame's CRS; none for a local frame), written atomically. Refused for an empty
/// grid or without bands.
[[nodiscard]] Result<void> writeGrid(const GridSpec& grid, const std::vector<GridBand>& bands,
                                     const GridDescription& description, const ProjectFrame& frame,
                                     const std::filesystem::path& path);

}  // namespace reflet
