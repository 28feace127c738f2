// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "importers/cityjson/CityJsonFile.h"

#include <filesystem>
#include <vector>

namespace reflet::cityjson {

/// Reads the "appearance" of a file: materials (colours made linear), textures by reference,
/// texture coordinates and default themes.
void readAppearance(JsonValue value, CityJsonFile& file, const JobContext& job);

/// Finds the images of the textures beside the file `path`, or in its folder `appearances`, without
/// opening them. Absolute paths, URLs and paths that lead out of the folder are not followed. What
/// was not found is reported, once for each reason.
[[nodiscard]] std::vector<CityTexture> resolveTextures(const std::vector<TextureEntry>& entries,
                                                       const std::filesystem::path& path,
                                                       std::vector<Diagnostic>& diagnostics);

}  // namespace reflet::cityjson
