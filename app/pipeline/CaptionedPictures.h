// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/ImageMetrics.h"

#include <span>
#include <string>
#include <vector>

namespace reflet {

/// A picture with what is written above it, in capitals; letters that DotFont does not have stay
/// blank, and what is wider than the picture is cut off.
struct CaptionedPicture {
    DisplayImage image;
    std::string caption;
};

/// One picture of several, on white: rows below one another, the pictures of a row side by side,
/// each below its caption.
[[nodiscard]] DisplayImage arranged(std::span<const std::vector<CaptionedPicture>> rows);

}  // namespace reflet
