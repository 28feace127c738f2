// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace reflet {

/// All textures of a city on the layers of one array texture: every level of each image lies there
/// as a rectangle with a border of one texel (which repeats or clamps), so that a shader filters
/// like MipTexture does, whatever the sizes and wrap modes.
struct TexturePages {
    int edge = 0;  ///< texels along a layer
    int layers = 0;
    std::vector<std::uint8_t> rgba;  ///< sRGB and alpha, rows from the top of the images
    /// Per texture (x, y of level 0 on its page, page | levels << 16 | repeat << 31,
    /// width | height << 16); levels = 0: missing.
    std::vector<glm::uvec4> places;
    int droppedLevels = 0;  ///< of the largest images, to keep to the budget

    /// Where a level of an image lies, relative to its level 0: level 1 begins right of level 0,
    /// the others below it.
    [[nodiscard]] static glm::ivec2 levelOffset(int width, int height, int level);
};

/// At most `budget` bytes: larger sets lose the finest levels of their largest images.
[[nodiscard]] TexturePages layOutTextures(const CityModel& city,
                                          const std::vector<TextureImage>& images,
                                          std::size_t budget);

}  // namespace reflet
