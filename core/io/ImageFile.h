// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"
#include "core/environment/EnvironmentMap.h"
#include "core/environment/ImageMetrics.h"

#include <filesystem>

namespace reflet {

/// Decodes PNG, JPEG, TIFF ... to 8-bit sRGB with alpha. Refuses (ResourceLimit) images above
/// `maxPixels` before anything is decoded; halves images until the longer edge is at most
/// `maxEdge`.
[[nodiscard]] Result<TextureImage> readTexture(const std::filesystem::path& path,
                                               std::size_t maxPixels = 64'000'000,
                                               int maxEdge = 2048);

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
