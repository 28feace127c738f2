// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"
#include "core/math/Geometry.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// What a city object is, as in CityGML / CityJSON; extensions and the rest are Other.
enum class CityObjectType : std::uint8_t {
    Building,
    BuildingPart,
    BuildingInstallation,
    Bridge,
    BridgePart,
    Tunnel,
    Road,
    Railway,
    TransportSquare,
    LandUse,
    TinRelief,
    WaterBody,
    PlantCover,
    SolitaryVegetation,
    CityFurniture,
    OtherConstruction,
    Generic,
    Group,
    Other,
};

/// What a semantic surface is.
enum class SurfaceType : std::uint8_t {
    Unknown,
    Ground,
    Wall,
    Roof,
    Window,
    Door,
    Closure,
    OuterCeiling,
    OuterFloor,
    InteriorWall,
    TrafficArea,
    AuxiliaryTrafficArea,
    Water,
    Other,
};

/// The CityJSON name of the type, e.g. "SolitaryVegetationObject".
[[nodiscard]] const char* toString(CityObjectType type);
[[nodiscard]] const char* toString(SurfaceType type);

struct CityObject {
    std::string id;
    CityObjectType type = CityObjectType::Other;
    std::string typeName;  ///< as written in the file ("+Tree" for extensions)
    std::string lod;       ///< of the geometry that was loaded, e.g. "2.2"; may be empty
    std::optional<std::uint32_t> parent;  ///< index into CityModel::objects
};

inline constexpr std::uint32_t kNone = 0xffffffffU;

/// One planar (or nearly planar) polygon of an object's geometry.
struct CitySurface {
    std::uint32_t object = 0;  ///< index into CityModel::objects
    SurfaceType type = SurfaceType::Unknown;
    std::uint32_t material = kNone;  ///< index into CityModel::materials
    std::uint32_t texture = kNone;   ///< index into CityModel::textures
    bool instance = false;           ///< placed from a geometry template
};

/// Colours are linear Rec. 709.
struct CityMaterial {
    std::string name;
    glm::vec3 diffuse{0.6F};
    glm::vec3 tint{1.0F};      ///< what the surface's texture is multiplied with, 0..1
    glm::vec3 emission{0.0F};  ///< radiance relative to a white surface in noon sun, >= 0
    float shininess = 0.0F;    ///< CityJSON's 0..1
    float transparency = 0.0F;
};

/// A part of a picture that has a place on the Earth: the rectangle of an orthophoto, north up.
struct PictureWindow {
    std::optional<std::string> crs;  ///< "EPSG:n" or WKT; nullopt = the picture's own
    glm::dvec2 min{0.0}, max{0.0};   ///< east and north in that system
    int width = 0, height = 0;       ///< pixels

    friend bool operator==(const PictureWindow&, const PictureWindow&) = default;
};

/// An image that is no file of its own: a range of the file CityTexture::path, or bytes that were
/// unpacked from it.
struct EmbeddedImage {
    std::uint64_t offset = 0, length = 0;
    std::shared_ptr<const std::string> bytes = nullptr;  ///< null: they are read from the range
};

/// What the see-through parts of an image are.
enum class TextureAlpha : std::uint8_t {
    Shown,    ///< they show the surface's colour
    Ignored,  ///< there are none, whatever the image says
    Closed,   ///< they take the mean colour of the rest of the image
};

/// An image by reference; decoded only when something is drawn with it.
struct CityTexture {
    std::string reference;  ///< as written in the file
    std::string path;       ///< resolved and confined to the file's folder; empty = missing
    bool repeat = true;     ///< wrap mode; false = clamp
    std::optional<PictureWindow> window = {};    ///< nullopt: all of the image
    std::optional<EmbeddedImage> embedded = {};  ///< nullopt: the file is the image
    TextureAlpha alpha = TextureAlpha::Shown;
};

/// A triangle: three vertices, the surface that it is part of. Front faces are counter-clockwise
/// seen from outside (where the source says so; many sources do not).
struct CityTriangle {
    std::array<std::uint32_t, 3> vertex{};
    std::uint32_t surface = 0;
};

/// A city in the project frame. A value: importers make it, everything else reads it.
struct CityModel {
    ProjectFrame frame;
    std::vector<CityObject> objects;
    std::vector<CitySurface> surfaces;
    std::vector<CityMaterial> materials;
    std::vector<CityTexture> textures;
    std::vector<glm::vec3> vertices;  ///< metres in the project frame
    std::vector<CityTriangle> triangles;
    std::vector<std::array<glm::vec2, 3>> uv;  ///< per triangle; empty, or one per triangle. v up.

    [[nodiscard]] Box bounds() const;
    /// Unit normal of the triangle by its vertex order; zero for a degenerate one.
    [[nodiscard]] glm::vec3 normal(std::size_t triangle) const;
};

/// True for objects that make up the bare ground: terrain, roads, land use, water, plant cover.
[[nodiscard]] bool isTerrain(CityObjectType type);

/// Appends `other` (same frame) to `model`, indices shifted.
void append(CityModel& model, const CityModel& other);

/// Adds a ground to a city that has none, as one TinRelief object "reflet-generated-ground" of
/// asphalt: a regular TIN over the model's bounds grown by `margin` metres, at most 40,000
/// triangles, cells of 5 m or more. Under and beside a building it lies 5 cm below the lowest base
/// around, so that it never rises above a base; between, its height is interpolated (inverse
/// distance); no slope along the grid is steeper than 45 degrees. Bridges and tunnels tell nothing
/// of it, nor do bases far off their neighbours' median. Deterministic, and independent of the
/// objects' order. No change if the model has triangles of a terrain object, or none at all.
/// Returns whether it added one.
bool addGeneratedGround(CityModel& model, double margin);

}  // namespace reflet
