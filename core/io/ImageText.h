// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/environment/ImageMetrics.h"

#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace reflet {

/// Words in a picture.
struct ImageText {
    enum class Align { Left, Middle, Right };
    std::string text;  ///< UTF-8, one line
    glm::ivec2 at{0};  ///< pixels: left, middle or right end, on the baseline
    int size = 14;     ///< pixels of a line's height
    glm::vec3 color{0.0F};
    Align align = Align::Left;
};

/// Pixels that a text is wide. Refused where the system has no font.
[[nodiscard]] Result<int> textWidth(const std::string& text, int size);

/// Writes words into a picture, with a sans-serif font of the system. Refused where there is none,
/// with what to install.
[[nodiscard]] Result<void> drawTexts(DisplayImage& image, const std::vector<ImageText>& texts);

}  // namespace reflet
