// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

namespace reflet {

struct EmbeddedShader {
    std::string_view name;  ///< of the file, without folder
    std::string_view text;
};

/// All files of resources/shaders; the definition is written by cmake/EmbedShaders.cmake.
[[nodiscard]] std::span<const EmbeddedShader> embeddedShaders();

}  // namespace reflet
