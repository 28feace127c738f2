// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"
#include "core/environment/EnvironmentMap.h"
#include "core/environment/ImageMetrics.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace reflet {

/// An image file, or an image within another file.
struct ImageSource {
    std::filesystem::path path;
    std::uint64_t offset = 0,
                  length = 0;  ///< bytes of the file that are PNG or JPEG; 0 = all of it
    std::shared_ptr<const std::string> bytes = nullptr;  ///< not null: they are the image
};

/// Pixels of the largest image that is decoded: photo textures come in 8192 x 8192.
inline constexpr std::size_t kLargestTexture = 100'000'000;

/// Decodes PNG, JPEG, TIFF ... to 8-bit sRGB with alpha. Refuses (ResourceLimit) images above
/// `maxPixels` before anything is decoded; halves images until the longer edge is at most
/// `maxEdge`, while they are read where the format allows it.
[[nodiscard]] Result<TextureImage> readTexture(const ImageSource& source,
                                               std::size_t maxPixels = kLargestTexture,
                                               int maxEdge = 2048);
[[nodiscard]] inline Result<TextureImage> readTexture(const std::filesystem::path& path,
                                                      std::size_t maxPixels = kLargestTexture,
                                                      int maxEdge = 2048) {
    return readTexture(ImageSource{path}, maxPixels, maxEdge);
}
/// Its pixels, by its header alone. Errors as readTexture().
[[nodiscard]] Result<glm::ivec2> textureSize(const ImageSource& source,
                                             std::size_t maxPixels = kLargestTexture);

/// 8-bit sRGB PNG of display values, written atomically.
[[nodiscard]] Result<void> writePng(const DisplayImage& image, const std::filesystem::path& path);

/// An environment map as one OpenEXR file: a 1 × 6 vertical strip of faces +X −X +Y −Y +Z −Z, texel
/// centres at +0.5 (not OpenEXR's border sampling, so no "envmap" attribute), channels R G B (half)
/// and Z (float, Euclidean distance in metres, +infinity for sky); attributes reflet:center (three
/// doubles as text), reflet:id. Written atomically. Radiance above half's range is clamped to
/// 65504.
[[nodiscard]] Result<void> writeEnvironmentMap(const std::string& id, const glm::dvec3& center,
                                               const CubeMap<glm::vec3>& radiance,
                                               const CubeMap<float>& distance,
                                               const std::filesystem::path& path);
/// Reads what writeEnvironmentMap wrote. Unreadable for anything else; NaN or negative radiance is
/// refused.
[[nodiscard]] Result<ReferenceEnvironmentMap> readEnvironmentMap(const std::filesystem::path& path);

[[nodiscard]] std::string openImageIoVersion();

}  // namespace reflet
