// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"
#include "core/base/Error.h"
#include "core/math/Geometry.h"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace reflet {

/// What a raster file says of itself; known without reading a pixel.
struct RasterInfo {
    std::string format;  ///< GDAL's name of it, e.g. "GTiff"
    int columns = 0, rows = 0, bands = 0;
    bool palette = false;
    bool bytes = false;   ///< all bands hold 8-bit numbers
    bool placed = false;  ///< it says where it lies
    /// x = t0 + t1 i + t2 j, y = t3 + t4 i + t5 j in its CRS, east first; i and j count corners of
    /// pixels from the top left one, whatever the file says of areas and points (GDAL's RFC 33):
    /// the centre of the first pixel is at i = j = 0.5.
    std::array<double, 6> transform{0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    std::optional<std::string> crs;  ///< WKT; compound where the file names a vertical datum
    /// Metres in which the first band says its heights are; nullopt = it does not say.
    std::optional<double> heightUnit;

    /// Colours rather than heights: three bands or more, or a palette.
    [[nodiscard]] bool isPicture() const { return bands >= 3 || palette; }
    /// Where a place in pixels (0.5 = the first one's centre) lies in the file's CRS.
    [[nodiscard]] glm::dvec2 at(double i, double j) const {
        return {transform[0] + transform[1] * i + transform[2] * j,
                transform[3] + transform[4] * i + transform[5] * j};
    }
};

/// A raster in a local file, read by GDAL: GeoTIFF, ESRI and other ASCII grids, XYZ, VRT over local
/// files, ERDAS, ENVI, DTED, SRTM, JPEG 2000, PNG and JPEG with a world file and others. What would
/// fetch from elsewhere is refused. One thread at a time.
class RasterFile {
public:
    /// Unreadable when it is no file that GDAL reads as a raster; Refused for a VRT over the
    /// network or an archive.
    [[nodiscard]] static Result<RasterFile> open(const std::filesystem::path& path);
    /// The same of a file in memory; `name` ends as the file's would.
    [[nodiscard]] static Result<RasterFile> openBytes(std::string_view bytes,
                                                      const std::string& name);
    /// Whether open() would take it: its first bytes tell, not its name.
    [[nodiscard]] static bool recognises(const std::filesystem::path& path);

    [[nodiscard]] const RasterInfo& info() const;

    /// Heights of the first band as the file means them (scale and offset applied, its own unit),
    /// row by row from the top; NaN where no-data value, mask or alpha leave a pixel out, and for
    /// what is no finite number. `heights` has columns * rows places. Unreadable where the data are
    /// damaged, ResourceLimit when its blocks are too large to be read one by one.
    [[nodiscard]] Result<void> readHeights(int firstColumn, int firstRow, int columns, int rows,
                                           float* heights) const;

    /// The colours over a rectangle of `crs` (WKT or "EPSG:n"; nullopt = the file's own system),
    /// north up, `width` by `height` pixels, brought there by averaging or bilinear interpolation,
    /// as may be; transparent where the file has none. 8-bit sRGB. Grey and palettes become
    /// colours. Refused for a file of other than 8 bits, Unreadable for damaged data.
    [[nodiscard]] Result<TextureImage> readPicture(const std::optional<std::string>& crs,
                                                   const glm::dvec2& min, const glm::dvec2& max,
                                                   int width, int height) const;

    RasterFile(RasterFile&&) noexcept;
    RasterFile& operator=(RasterFile&&) noexcept;
    ~RasterFile();

private:
    struct Impl;
    explicit RasterFile(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
