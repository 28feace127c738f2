// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Files.h"
#include "core/geo/Crs.h"
#include "core/io/GdalSession.h"
#include "core/io/GeoFile.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

namespace {

constexpr std::size_t kMostSpans = 16;  // of a column that are written

struct Layer {
    std::string name;
    std::function<float(std::size_t cell)> height;
    const std::vector<float>* stored = nullptr;  ///< of a layer that the heightfield holds
};

Layer storedLayer(const char* name, const std::vector<float>& heights) {
    return {name, [&heights](std::size_t cell) { return heights[cell]; }, &heights};
}

/// A bound of the n-th solid stretch of each column, from 0; missing where there is none.
Layer spanLayer(std::string name, const Heightfield& field, std::size_t n,
                float HeightSpan::*bound) {
    return {std::move(name), [&field, n, bound](std::size_t cell) {
                const auto column = field.spans.at(cell);
                return n < column.size() ? column[n].*bound : kMissingHeight;
            }};
}

std::size_t mostSpans(const Heightfield& field) {
    std::size_t most = 1;
    for (std::size_t n = 1; n < field.spans.first().size(); ++n)
        most = std::max<std::size_t>(most, field.spans.first()[n] - field.spans.first()[n - 1]);
    return most;
}

std::vector<Layer> chosenLayers(const Heightfield& field, int count) {
    if (count == 1)
        return {storedLayer("top_max", field.topMax)};
    std::vector<Layer> layers{storedLayer("ground", field.ground),
                              storedLayer("top_max", field.topMax)};
    if (count == 3)
        layers.push_back(storedLayer("top_center", field.topCenter));
    layers.push_back(spanLayer("ceil_min", field, 1, &HeightSpan::low));
    layers.push_back(spanLayer("over_top", field, 1, &HeightSpan::high));
    if (count < 3)
        return layers;
    layers.push_back({"base_top", [&field](std::size_t cell) {
                          const auto column = field.spans.at(cell);
                          return column.empty() ? field.topMax[cell] : column.front().high;
                      }});
    for (std::size_t n = 2; n < std::min(mostSpans(field), kMostSpans); ++n) {
        layers.push_back(spanLayer(fmt::format("low_{}", n + 1), field, n, &HeightSpan::low));
        layers.push_back(spanLayer(fmt::format("high_{}", n + 1), field, n, &HeightSpan::high));
    }
    return layers;
}

/// The frame's system, compound where the heights' datum is known; nullopt for a local frame.
Result<std::optional<OGRSpatialReference>> spatialReference(const ProjectFrame& frame) {
    if (!frame.crs)
        return std::nullopt;
    const auto parsed = Crs::parse(*frame.crs);
    if (!parsed)
        return tl::unexpected(parsed.error());
    OGRSpatialReference horizontal;
    if (horizontal.importFromWkt(parsed->wkt().c_str()) != OGRERR_NONE)
        return fail(ErrorCode::Internal, "GDAL does not take PROJ's WKT", *frame.crs);
    OGRSpatialReference vertical;
    if (!frame.vertical || vertical.SetFromUserInput(frame.vertical->c_str()) != OGRERR_NONE)
        return horizontal;
    const std::string name =
        std::string(horizontal.GetName()) + " + " + std::string(vertical.GetName());
    OGRSpatialReference compound;
    if (compound.SetCompoundCS(name.c_str(), &horizontal, &vertical) != OGRERR_NONE)
        return horizontal;
    return compound;
}

void describe(GDALDataset& dataset, const Heightfield& field, const ProjectFrame& frame) {
    const GridSpec& grid = field.grid;
    double transform[6] = {frame.origin.x + grid.x0,     grid.cellSize, 0.0,
                           frame.origin.y + grid.yMax(), 0.0,           -grid.cellSize};
    dataset.SetGeoTransform(transform);
    dataset.SetMetadataItem(GDALMD_AREA_OR_POINT, GDALMD_AOP_AREA);
    dataset.SetMetadataItem("TIFFTAG_SOFTWARE", "Reflet " REFLET_VERSION);
    dataset.SetMetadataItem("REFLET_VERSION", REFLET_VERSION);
    dataset.SetMetadataItem("REFLET_CELL_SIZE", fmt::format("{}", grid.cellSize).c_str());
    dataset.SetMetadataItem(
        "REFLET_ORIGIN",
        fmt::format("{} {} {}", frame.origin.x, frame.origin.y, frame.origin.z).c_str());
    dataset.SetMetadataItem("REFLET_VERTICAL", frame.vertical.value_or("unknown").c_str());
}

bool writeBand(GDALRasterBand& band, const Layer& layer, const GridSpec& grid, double zOrigin) {
    band.SetDescription(layer.name.c_str());
    band.SetUnitType("metre");
    band.SetNoDataValue(double(kMissingHeight));
    std::vector<float> row(std::size_t(grid.columns));
    for (int j = 0; j < grid.rows; ++j) {
        const std::size_t first = grid.index(0, j);
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = float(layer.height(first + i) + zOrigin);
        // Row 0 is south here, north in the file.
        if (band.RasterIO(GF_Write, 0, grid.rows - 1 - j, grid.columns, 1, row.data(), grid.columns,
                          1, GDT_Float32, 0, 0, nullptr) != CE_None)
            return false;
    }
    return true;
}

Result<void> writeTiff(const Heightfield& field, const ProjectFrame& frame,
                       const std::vector<Layer>& layers,
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
    GdalDataset dataset(driver->Create(path.c_str(), field.grid.columns, field.grid.rows,
                                       int(layers.size()), GDT_Float32,
                                       const_cast<char**>(options)));
    if (!dataset)
        return failed();
    if (crs)
        dataset->SetSpatialRef(&*crs);
    describe(*dataset, field, frame);
    for (std::size_t k = 0; k < layers.size(); ++k)
        if (!writeBand(*dataset->GetRasterBand(int(k) + 1), layers[k], field.grid, frame.origin.z))
            return failed();
    dataset.reset();  // the file is complete, or a failure was reported, only now
    if (session.failed())
        return failed();
    return {};
}

}  // namespace

Result<void> writeHeightfield(const Heightfield& field, const ProjectFrame& frame, int layers,
                              const std::filesystem::path& path) {
    if (layers < 1 || layers > 3)
        return fail(ErrorCode::Usage,
                    "a heightfield has one to three layers, not " + std::to_string(layers),
                    path.string(), "Choose 1, 2 or 3.");
    const std::vector<Layer> chosen = chosenLayers(field, layers);
    for (const Layer& layer : chosen)
        if (field.grid.cellCount() == 0 ||
            (layer.stored != nullptr && layer.stored->size() != field.grid.cellCount()))
            return fail(ErrorCode::Refused, "the layer " + layer.name + " is empty", path.string());
    const auto crs = spatialReference(frame);
    if (!crs)
        return tl::unexpected(crs.error());
    return writeAtomically(path, [&](const std::filesystem::path& temporary) {
        return writeTiff(field, frame, chosen, *crs, temporary);
    });
}

}  // namespace reflet
