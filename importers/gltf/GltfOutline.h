// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/math/Geometry.h"

#include <cstddef>
#include <filesystem>

namespace reflet::gltf {

/// What the description of a glTF file tells without its data.
struct Outline {
    std::size_t triangles = 0;   ///< by its own counts, instances counted
    Box bounds;                  ///< of the meshes in place, by what their accessors say; y up
    bool georeferenced = false;  ///< it says where it lies, or a file beside it does
};

/// Reads the description alone of a .gltf, .glb or .b3dm. Errors as importVehicleBytes(), and
/// Refused for other files.
[[nodiscard]] Result<Outline> readOutline(const std::filesystem::path& file);

}  // namespace reflet::gltf
