// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"

#include <filesystem>
#include <string_view>

namespace reflet {

/// Reads a Wavefront OBJ file with its materials (MTL) as a city: each object (o), or, in a file
/// of one object, each group (g), becomes a city object; what it is, is told by its name or those
/// of its materials, else it is a building. An object with materials of several kinds ("Terrain",
/// "Building") becomes one for each kind. Faces may have any number of corners. The CRS is that of
/// a .prj file beside it, else `options.crs`; `options.upAxis` and `options.unit` say how its
/// numbers are meant. Libraries of materials and images are looked for in the file's folder only.
/// Unreadable for a file without faces or with no vertex that can be read.
[[nodiscard]] Result<Imported<CityImport>> importObj(const std::filesystem::path& path,
                                                     const ImportOptions& options,
                                                     const JobContext& job);
/// The same of bytes; `path` names them.
[[nodiscard]] Result<Imported<CityImport>> importObjBytes(std::string_view bytes,
                                                          const std::filesystem::path& path,
                                                          const ImportOptions& options,
                                                          const JobContext& job);
/// What is in it.
[[nodiscard]] Result<Imported<SourceSummary>> inspectObj(const std::filesystem::path& path,
                                                         const ImportOptions& options,
                                                         const JobContext& job);

}  // namespace reflet
