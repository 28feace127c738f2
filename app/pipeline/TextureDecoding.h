// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"
#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"
#include "core/city/CityModel.h"

#include <vector>

namespace reflet {

/// Bytes that the decoded textures of a city may take together.
inline constexpr double kTextureBudget = 256.0 * 1024 * 1024;

/// What the budget leaves of images of these sizes (pixels; nothing of those that are unknown).
struct TextureCap {
    int edge = 2048;          ///< the longest edge: a power of two, 64 or more
    std::size_t reduced = 0;  ///< images that are longer
};
[[nodiscard]] TextureCap textureCap(const std::vector<glm::ivec2>& sizes,
                                    double budget = kTextureBudget);

/// Decodes the textures of a city, halved until all of them fit the budget. One image for each, an
/// empty one where it is missing or cannot be read, which is told, as is what was halved. Of a job
/// that is cancelled the images are of no use.
[[nodiscard]] std::vector<TextureImage> decodeTextures(const std::vector<CityTexture>& references,
                                                       std::vector<Diagnostic>& remarks,
                                                       const JobContext& job);

/// Makes an image as TextureAlpha says.
void settleAlpha(TextureImage& image, TextureAlpha alpha);

}  // namespace reflet
