// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"

#include <glm/mat4x4.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet::gltf {

class Document;

/// Where a glTF file says that it lies.
struct Georeference {
    std::string crs;  ///< as Crs::parse() reads it, with the vertical part; may be empty: not told
    glm::dmat4 crs_from_file{1.0};  ///< of coordinates with z up; into geocentric ones where it is
                                    ///< placed by longitude and latitude
    bool zUp = false;               ///< the file's own coordinates have z up
};

/// The first that there is: the reference system of the file (EXT_geospatial_crs) or of its nodes
/// (EXT_georeference); "georeference" in asset.extras; a file beside it: NAME.glb.geo.json,
/// NAME.wld3 (Esri; pairs of points), NAME.kml (a Model with its Location). What of them cannot be
/// used is told.
[[nodiscard]] std::optional<Georeference> georeferenceOf(const Document& document,
                                                         std::vector<Diagnostic>& remarks);

/// Whether a file of that name beside a glTF file places it, or tells its reference system.
[[nodiscard]] bool hasGeoreferenceBeside(const std::filesystem::path& path);

/// Pairs of points "x,y,z X,Y,Z", one or two: offset, or offset, rotation and scale in the plane
/// and an offset of the height. nullopt for other text.
[[nodiscard]] std::optional<glm::dmat4> readWorldFile(std::string_view text);
/// The place of the first Model of a KML text: from coordinates with z up, y north where it heads
/// there, to geocentric ones. nullopt where there is none, or one that cannot be.
[[nodiscard]] std::optional<glm::dmat4> readKmlModel(std::string_view text);

}  // namespace reflet::gltf
