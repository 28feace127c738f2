// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <string_view>
#include <vector>

namespace reflet {

/// The ways to get a local map that can be compared at the same pose (DESIGN 5.8).
enum class Method {
    Sky,       ///< the bare sky: what a vehicle shows without any probe
    Nearest,   ///< the nearest REM, as if at infinity
    Blend,     ///< two REMs, as if at infinity
    Box,       ///< the nearest REM, as if on the box that its own distances show
    Mem,       ///< multiple environment maps, DESIGN 5.3
    Dense,     ///< the same without a mesh: a ray for each texel
    PerPixel,  ///< without a map: a ray for each pixel of the body, from there; its map is Dense
    RayTrace,  ///< the truth: rays in the full mesh
    Rerender,  ///< the full mesh drawn into six faces by OpenGL, as racing games do
};

/// "sky", "nearest", "blend", "box", "mem", "dense", "per-pixel", "raytrace", "rerender".
[[nodiscard]] const char* toString(Method method);
/// Usage for an unknown name, listing the known ones.
[[nodiscard]] Result<Method> methodFromString(std::string_view name);
[[nodiscard]] const std::vector<Method>& allMethods();
/// Whether it is made of the pictures of REMs: without any it shows nothing.
[[nodiscard]] bool needsProbes(Method method);

}  // namespace reflet
