// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/Error.h"
#include "core/base/JobContext.h"
#include "core/traffic/GltfModel.h"

#include <filesystem>
#include <string_view>

namespace reflet {

struct GltfOptions {
    std::size_t maxFileBytes = std::size_t(1) << 30;
    /// Refused above this, from the file's own counts and before anything is allocated.
    std::size_t maxTriangles = 20'000'000;
    /// Simplified above this; also the most that a texture may be cut into.
    std::size_t mostKept = 300'000;
    /// Refused when so many are left: a file of many small parts, which are not simplified.
    std::size_t mostLeft = 2'000'000;
};

/// Reads the meshes of a glTF 2.0 file (.gltf or .glb) as a vehicle. Buffers and images are read
/// from the file's own folder only. Unreadable for what is no glTF or is cut off, Refused for a
/// file without triangles or one that needs an extension that Reflet does not know, ResourceLimit
/// above the limits. What can be left out is left out and told as a diagnostic.
[[nodiscard]] Result<Imported<GltfModel>> importVehicle(const std::filesystem::path& path,
                                                        const GltfOptions& options,
                                                        const JobContext& job);

/// The same from bytes; `path` names them and its folder is where other files are looked for.
[[nodiscard]] Result<Imported<GltfModel>> importVehicleBytes(std::string_view bytes,
                                                             const std::filesystem::path& path,
                                                             const GltfOptions& options,
                                                             const JobContext& job);

}  // namespace reflet
