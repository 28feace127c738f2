// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/ImportTypes.h"

#include <filesystem>

namespace reflet {

/// Reads 3D Tiles 1.0 or 1.1 from their tileset.json at their finest (see readTileTree): glTF,
/// b3dm, i3dm and cmpt. Each feature (EXT_mesh_features, batch table) becomes a city object, named
/// by its identifier where it has one; else each node of a tile. Geocentric tiles (EPSG:4978) are
/// brought into the project's CRS vertex by vertex, their heights stay above the ellipsoid; others
/// are in `options.crs` or local, with z up. Textures are those of the tiles, by reference. A
/// tile that cannot be read costs that tile. Unreadable when no tile can be read, Refused for a
/// tileset in the network.
[[nodiscard]] Result<Imported<CityImport>> importTiles(const std::filesystem::path& path,
                                                       const ImportOptions& options,
                                                       const JobContext& job);
/// What is in them, at their finest.
[[nodiscard]] Result<Imported<SourceSummary>> inspectTiles(const std::filesystem::path& path,
                                                           const ImportOptions& options,
                                                           const JobContext& job);

/// Reads a glTF file (or a b3dm, i3dm or cmpt) as a city. Where it lies is told, in this order, by
/// CESIUM_RTC and coordinates on the Earth's surface, which are geocentric; by
/// asset.extras.georeference or a file NAME.geo.json: {"crs", "vertical", "origin", "upAxis"}; by a
/// .prj file of its name; by `options.crs`; else it is local. `options.upAxis` and `options.unit`
/// say how its numbers are meant, y up and metres unless said.
[[nodiscard]] Result<Imported<CityImport>> importGltfCity(const std::filesystem::path& path,
                                                          const ImportOptions& options,
                                                          const JobContext& job);
[[nodiscard]] Result<Imported<SourceSummary>> inspectGltfCity(const std::filesystem::path& path,
                                                              const ImportOptions& options,
                                                              const JobContext& job);

}  // namespace reflet
