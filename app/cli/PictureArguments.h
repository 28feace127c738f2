// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/Arguments.h"
#include "core/base/Error.h"
#include "core/reconstruction/Method.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>

namespace reflet::cli {

/// What pictures and films have in common on the command line, checked.
struct PictureArguments {
    int width = 0;
    int height = 0;
    Method method = Method::Mem;
    std::optional<Method> right;  ///< of the wipe
    float wipe = 0.5F;
};

/// "1920x1080" as width and height, each 16 to 16384; else Usage.
[[nodiscard]] Result<glm::ivec2> pictureSize(const std::string& text);

/// Usage for a size, a method or a pair of methods that there is not.
[[nodiscard]] Result<PictureArguments> pictureArguments(const RenderArguments& arguments);

}  // namespace reflet::cli
