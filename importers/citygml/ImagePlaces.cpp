// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/ImagePlaces.h"

#include "core/io/RasterFile.h"
#include "importers/common/TextureFiles.h"

#include <cmath>

namespace reflet::citygml {

namespace {

/// x = t0 + t1 i + t2 j, y = t3 + t4 i + t5 j from corners of pixels, as in RasterInfo.
std::optional<PlaneProjection> inverse(const std::array<double, 6>& t, int columns, int rows) {
    const double det = t[1] * t[5] - t[2] * t[4];
    const double size = (std::abs(t[1]) + std::abs(t[2])) * (std::abs(t[4]) + std::abs(t[5]));
    if (!(std::abs(det) > 1e-12 * size) || !std::isfinite(t[0] + t[3]))
        return std::nullopt;
    const double perColumn = 1.0 / (det * columns), perRow = 1.0 / (det * rows);
    PlaneProjection out;
    out.corner = {t[0], t[3]};
    out.rows = {t[5] * perColumn, -t[2] * perColumn, 0.0, t[4] * perRow, -t[1] * perRow, 1.0};
    return out;
}

}  // namespace

const ImagePlaces::Image& ImagePlaces::imageOf(const std::string& image) {
    const auto [known, isNew] = m_images.try_emplace(image);
    if (!isNew)
        return known->second;
    const auto path = importers::textureFile(image, m_file);
    if (!path)
        return known->second;
    if (const auto raster = RasterFile::open(*path)) {
        const RasterInfo& info = raster->info();
        known->second = {true, info.columns, info.rows, std::nullopt};
        if (info.placed)
            known->second.transform = info.transform;
    }
    return known->second;
}

ImagePlaces::Place ImagePlaces::place(const std::string& name, const Georeference& georeference) {
    const Image& image = imageOf(name);
    if (!image.found)
        return {};
    if (georeference.orientation) {
        const auto [a, b, c, d] = *georeference.orientation;
        const glm::dvec2& first = georeference.referencePoint;
        return {true, inverse({first.x - 0.5 * (a + b), a, b, first.y - 0.5 * (c + d), c, d},
                              image.columns, image.rows)};
    }
    if (!image.transform)
        return {true, std::nullopt};
    auto projection = inverse(*image.transform, image.columns, image.rows);
    if (projection)
        projection->eastFirst = true;
    return {true, projection};
}

}  // namespace reflet::citygml
