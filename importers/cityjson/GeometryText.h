// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/cityjson/CityJsonFile.h"
#include "importers/common/ImportReport.h"

#include <optional>
#include <string>
#include <vector>

namespace reflet::cityjson {

/// Tells of something odd: what, the first case in words, how many cases.
using Noter = Borrowed<void(Issue, std::string, std::size_t)>;

/// One geometry as its JSON has it, before anything is checked against the vertices. Reused from
/// geometry to geometry, so that its arrays are allocated once.
struct GeometryText {
    GeometryType type = GeometryType::Unknown;
    NestedIndices boundaries;

    std::vector<SurfaceType> semanticTypes;
    NestedIndices semantics;

    std::optional<std::uint32_t> material;  ///< of the whole geometry
    NestedIndices materials;                ///< of its surfaces
    std::string materialTheme;
    bool materialsWithoutAppearance = false;  ///< materials are named, but the file has none

    NestedIndices textures;
    std::string textureTheme;

    std::optional<std::array<double, 16>> matrix;
};

/// Reads one geometry of a known type. Of several themes the file's default counts, else the first;
/// indices of materials are checked in all of them.
void readGeometryText(JsonValue value, const SourceCity& file, GeometryType type, Noter note,
                      GeometryText& into);

}  // namespace reflet::cityjson
