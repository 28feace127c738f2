// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/GridFile.h"

#include "core/base/Files.h"
#include "core/io/GdalFrame.h"
#include "core/io/GdalSession.h"

#include <fmt/format.h>

#include <optional>

namespace reflet {

namespace {

void describe(GDALDataset& dataset, const GridSpec& grid, const GridDescription& description,
              const ProjectFrame& frame) {
    double transform[6] = {frame.origin.x + grid.x0,     grid.cellSize, 0.0,
                           frame.origin.y + grid.yMax(), 0.0,           -grid.cellSize};
    dataset.SetGeoTransform(transform);
    dataset.SetMetadataItem(GDALMD_AREA_OR_POINT, GDALMD_AOP_AREA);
    dataset.SetMetadataItem("TIFFTAG_SOFTWARE", "Reflet " REFLET_VERSION);
    dataset.SetMetadataItem("REFLET_VERSION", REFLET_VERSION);
    for (const auto& [key, value] : description.metadata)
        dataset.SetMetadataItem(key.c_str(), value.c_str());
}

bool writeBand(GDALRasterBand& band, const GridBand& layer, const GridSpec& grid) {
    band.SetDescription(layer.name.c_str());
    if (!layer.unit.empty())
        band.SetUnitType(layer.unit.c_str());
    band.SetNoDataValue(double(kMissingHeight));
    std::vector<float> row(std::size_t(grid.columns));
    for (int j = 0; j < grid.rows; ++j) {
        const std::size_t first = grid.index(0, j);
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = float(layer.valueAt(first + i));
        // Row 0 is south here, north in the file.
        if (band.RasterIO(GF_Write, 0, grid.rows - 1 - j, grid.columns, 1, row.data(), grid.columns,
                          1, GDT_Float32, 0, 0, nullptr) != CE_None)
            return false;
    }
    return true;
}

Result<void> writeTiff(const GridSpec& grid, const std::vector<GridBand>& bands,
                       const GridDescription& description, const ProjectFrame& frame,
                       const std::optional<OGRSpatialReference>& crs,
                       const std::filesystem::path& path) {
    const GdalSession session;
    const auto failed = [&] {
        return fail(ErrorCode::WriteFailed, "GDAL could not write it: " + session.message(),
                    path.string(), "Check the free space and the permissions of the folder.");
    };
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    if (driver == nullptr)
        return fail(ErrorCode::Internal, "GDAL has no GeoTIFF driver", path.string(),
                    "Install libgdal32 of Debian.");
    const char* const options[] = {"TILED=YES",       "COMPRESS=DEFLATE", "PREDICTOR=3",
                                   "INTERLEAVE=BAND", "BIGTIFF=IF_SAFER", nullptr};
    GdalDataset dataset(driver->Create(path.c_str(), grid.columns, grid.rows, int(bands.size()),
                                       GDT_Float32, const_cast<char**>(options)));
    if (!dataset)
        return failed();
    if (crs)
        dataset->SetSpatialRef(&*crs);
    describe(*dataset, grid, description, frame);
    for (std::size_t k = 0; k < bands.size(); ++k)
        if (!writeBand(*dataset->GetRasterBand(int(k) + 1), bands[k], grid))
            return failed();
    dataset.reset();  // the file is complete, or a failure was reported, only now
    if (session.failed())
        return failed();
    return {};
}

}  // namespace

Result<void> writeGrid(const GridSpec& grid, const std::vector<GridBand>& bands,
                       const GridDescription& description, const ProjectFrame& frame,
                       const std::filesystem::path& path) {
    if (grid.cellCount() == 0 || bands.empty())
        return fail(ErrorCode::Refused, "there is nothing to write", path.string());
    const auto crs =
        description.heights ? gdal::spatialReference(frame) : gdal::horizontalReference(frame);
    if (!crs)
        return tl::unexpected(crs.error());
    return writeAtomically(path, [&](const std::filesystem::path& temporary) {
        return writeTiff(grid, bands, description, frame, *crs, temporary);
    });
}

}  // namespace reflet
