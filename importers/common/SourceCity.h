// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"
#include "core/math/Geometry.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// What the readers of all city formats hand on, before anything is placed or triangulated.
namespace reflet::importers {

enum class GeometryType : std::uint8_t {
    MultiPoint,
    MultiLineString,
    MultiSurface,
    CompositeSurface,
    Solid,
    MultiSolid,
    CompositeSolid,
    Instance,
    Unknown,
};

/// Levels of arrays in the boundaries of a geometry with surfaces; 0 for the others.
[[nodiscard]] int boundaryDepth(GeometryType type);
[[nodiscard]] const char* toString(GeometryType type);

/// A geometry as far as it must be known before its boundaries are read.
struct GeometryOutline {
    GeometryType type = GeometryType::Unknown;
    std::string typeName;                 ///< only of unknown ones
    std::uint32_t lod = 0;                ///< index into SourceCity::lodNames
    std::uint32_t templateIndex = kNone;  ///< of instances
    bool onlyReferences = false;          ///< its surfaces are those of other geometries
};

/// A city object without its boundaries.
struct ObjectOutline {
    std::string id;
    std::string typeName;
    CityObjectType type = CityObjectType::Other;
    std::vector<std::string> parentIds;
    bool hasChildren = false;
    bool aboveGround =
        false;  ///< its heights count from the ground, as CityImport::aboveGround tells
    bool explained = false;    ///< the reader itself says why there is no geometry
    bool isObject = true;      ///< false: something else stands in its place
    bool duplicate = false;    ///< an earlier object has the same id
    bool isKnown = true;       ///< its type is one that the format defines
    bool isBoundary = false;   ///< a wall, a window, ...: a surface of its parent (CityGML)
    bool badGeometry = false;  ///< "geometry" is neither an array nor null
    std::uint32_t firstGeometry = 0;
    std::uint32_t geometryCount = 0;
};

/// The transform of the file: coordinate = scale * number + translate.
struct VertexTransform {
    glm::dvec3 scale{1.0};
    glm::dvec3 translate{0.0};
};

struct TextureEntry {
    std::string image;  ///< as written; what tells one image of a city from another
    bool repeat = true;
    TextureAlpha alpha = TextureAlpha::Shown;
    /// Of an image within a file `path`, which is empty where its bytes are not there as said.
    std::optional<EmbeddedImage> embedded = {};
    std::string path = {};
};

/// Everything of a file but the geometry itself.
struct SourceCity {
    std::string format;                          ///< "CityJSON"
    std::string version;                         ///< as written
    std::optional<std::string> referenceSystem;  ///< as written, or "EPSG:n" of CityJSON 1.0's crs
    std::optional<VertexTransform> transform;
    std::vector<glm::dvec3> vertices;  ///< the numbers of the file; NaN = no point
    std::vector<glm::dvec3> templateVertices;
    std::vector<glm::vec2> textureVertices;
    std::vector<CityMaterial> materials;
    std::vector<TextureEntry> textures;
    std::string defaultMaterialTheme;
    std::string defaultTextureTheme;
    std::vector<std::string> lodNames;        ///< distinct, as in CityObject::lod
    std::vector<ObjectOutline> objects;       ///< in the order of the file
    std::vector<GeometryOutline> geometries;  ///< of all objects, one after the other
    std::vector<GeometryOutline> templates;
};

}  // namespace reflet::importers
