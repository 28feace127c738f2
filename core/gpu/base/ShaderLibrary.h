// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/Program.h"

#include <string>
#include <string_view>
#include <vector>

// The shaders of resources/shaders, embedded when Reflet is built: a new file there is found when
// CMake runs again. File names are domain_name.stage.glsl, stage one of vert, frag, comp, geom;
// parts for #include have no stage. Stages start with `#version 450 core`.

namespace reflet {

/// Text of an embedded file by its name, for example "city_surface.frag.glsl"; Internal when there
/// is none.
[[nodiscard]] Result<std::string_view> shaderText(std::string_view file);
/// All embedded files, sorted.
[[nodiscard]] std::vector<std::string> shaderFiles();

/// A stage with its #include "part.glsl" lines resolved (each part once), and with the defines,
/// for example "SAMPLES 4", set after the version.
[[nodiscard]] Result<std::string> shaderSource(std::string_view file,
                                               const std::vector<std::string>& defines = {});

/// Names of all programs: one for each fragment or compute shader, without stage and ending.
[[nodiscard]] std::vector<std::string> programNames();
/// The stages of a program by name: NAME.comp.glsl, or NAME.frag.glsl with NAME.geom.glsl where
/// there is one and NAME.vert.glsl; a line `// vertex: OTHER.vert.glsl` in the fragment shader
/// names another vertex shader.
[[nodiscard]] Result<std::vector<std::string>> programStages(std::string_view name);

/// Compiles and links a program in the current context. Internal when that fails, with the file and
/// all that the driver said.
[[nodiscard]] Result<Program> makeProgram(std::string_view name,
                                          const std::vector<std::string>& defines = {});

}  // namespace reflet
