// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoverageReport.h"

#include <filesystem>

namespace reflet {

/// Writes a report by the suffix of the path:
///
/// - .json: coverageJson(); .csv: a row for each route;
/// - .geojson and .gpkg: layers "stretches" (lines), "worst" (points), "probes" (points), "facades"
///   (points: patches of what is reflected, with area and coverage) and for ground "ground"
///   (points: middles of cells);
/// - .tif: bands "coverage" and "seen" (0..1) where vehicles are, no-data elsewhere;
/// - .png: a plan (coveragePicture()).
///
/// Usage for another suffix.
[[nodiscard]] Result<void> writeCoverage(const CoverageReport& report, const PreparedCity& city,
                                         const std::filesystem::path& path);

/// Coverage over the places of vehicles, as a raster in the project frame.
struct CoverageRaster {
    GridSpec grid;
    std::vector<float> coverage, seen;  ///< 0..1 by GridSpec::index; NaN where no vehicle is

    static constexpr double kLaneWidth = 4.0;   ///< metres that a route is drawn wide
    static constexpr double kGroundCell = 5.0;  ///< metres of a cell of ground
};
/// Of routes: each cell of a metre within a lane's width has the figures of the nearest stretch, of
/// several at the same place the worst. Of ground: the means over cells of kGroundCell, or of a
/// multiple of it where there are too few samples for that. Empty where there are no samples.
[[nodiscard]] CoverageRaster coverageRaster(const CoverageReport& report);

}  // namespace reflet
