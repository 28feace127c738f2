// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "importers/common/SourceCity.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet::importers {

/// Finds the images of the textures beside the file `path`, or in its folder `appearances`, without
/// opening them; embedded ones are taken as they are. Absolute paths, URLs and paths that lead out
/// of the folder are not followed. What was not found is reported, once for each reason.
[[nodiscard]] std::vector<CityTexture> resolveTextures(const std::vector<TextureEntry>& entries,
                                                       const std::filesystem::path& path,
                                                       std::vector<Diagnostic>& diagnostics);

/// The file of one image, found in the same way; nullopt where it would be reported.
[[nodiscard]] std::optional<std::filesystem::path> textureFile(const std::string& image,
                                                               const std::filesystem::path& path);

}  // namespace reflet::importers
