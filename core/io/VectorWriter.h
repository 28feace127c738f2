// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace reflet {

/// A value of a column; monostate = none.
using VectorValue = std::variant<std::monostate, std::string, double, std::int64_t, bool>;

struct VectorColumn {
    enum class Kind { Text, Real, Integer, Yes };
    std::string name;
    Kind kind = Kind::Text;
};

/// One thing of a layer: a point, or the corners of a line.
struct VectorShape {
    std::vector<glm::dvec3> points;   ///< absolute, in the frame's CRS and datum
    std::vector<VectorValue> values;  ///< one for each column
};

/// A layer to be written.
struct WrittenLayer {
    enum class Kind { Points, Lines };
    std::string name;
    Kind kind = Kind::Points;
    std::vector<VectorColumn> columns;
    std::vector<VectorShape> shapes;
};

/// Writes layers as a GeoPackage (.gpkg: a layer each, in the frame's CRS) or as one GeoJSON
/// (.geojson: longitude and latitude by RFC 7946, all features in one collection, told apart by
/// their property "layer"; those of a local frame keep its metres). Columns of one name in several
/// layers must be of one kind. Written atomically. Usage for another suffix; Refused where PROJ
/// knows no way to WGS 84.
[[nodiscard]] Result<void> writeVector(const std::vector<WrittenLayer>& layers,
                                       const ProjectFrame& frame,
                                       const std::filesystem::path& path);

}  // namespace reflet
