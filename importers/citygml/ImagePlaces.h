// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>

namespace reflet::citygml {

/// Where a GeoreferencedTexture says itself that its image lies, as a world file would: the centre
/// of the first pixel, and the steps to the next one to the right (a, c) and below (b, d).
struct Georeference {
    std::optional<std::array<double, 4>> orientation;  ///< a b c d
    glm::dvec2 referencePoint{0.0};
};

/// Places in the plane to coordinates of a texture, v upwards.
struct PlaneProjection {
    /// u = r0 x + r1 y + r2, v = r3 x + r4 y + r5, of offsets from the image's first corner.
    std::array<double, 6> rows{};
    glm::dvec2 corner{0.0};
    bool eastFirst = false;  ///< by the image's own file; else in the order of the city's file

    [[nodiscard]] glm::dvec2 operator()(const glm::dvec2& p) const {
        const glm::dvec2 q = p - corner;
        return {rows[0] * q.x + rows[1] * q.y + rows[2], rows[3] * q.x + rows[4] * q.y + rows[5]};
    }
};

/// Where the images of the GeoreferencedTextures of a file lie: by what the texture says (CityGML
/// 2.0, 9.3), else by the image's world file or its own georeference, as GDAL reads them. Only
/// the heads of images are read, of those beside the file alone.
class ImagePlaces {
public:
    explicit ImagePlaces(std::filesystem::path cityFile) : m_file(std::move(cityFile)) {}

    struct Place {
        bool found = false;  ///< the image; it is reported elsewhere where it is missing
        std::optional<PlaneProjection> projection;
    };
    [[nodiscard]] Place place(const std::string& image, const Georeference& georeference);

private:
    struct Image {
        bool found = false;
        int columns = 0, rows = 0;
        std::optional<std::array<double, 6>> transform;  ///< of RasterInfo
    };
    [[nodiscard]] const Image& imageOf(const std::string& image);

    std::filesystem::path m_file;
    std::unordered_map<std::string, Image> m_images;
};

}  // namespace reflet::citygml
