// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/city/CityModel.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace reflet {

/// What a surface looks like when no texture says so.
enum class LookKind : std::uint8_t {
    Solid,    ///< one colour: explicit materials, furniture, openings
    Facade,   ///< storeys, bays, windows
    Plaster,  ///< a wall without windows of its own (they are modelled, or it is no storey wall)
    FlatRoof,
    TiledRoof,
    Asphalt,
    Slabs,   ///< pavement
    Paving,  ///< a square's stone pattern
    Grass,
    Earth,  ///< terrain of no particular use
    Water,
    Foliage,
    Stone,  ///< bridges, kerbs and other masonry
};

/// How a surface is drawn. Depends on the city alone.
///
/// The rule of colours, in this order: a texture; else, on walls, a material whose name starts with
/// "facade", or that has no name, tints a procedural façade, and any other material is taken as it
/// is; else, on all other surfaces, the material as it is ("plain…" or not); else a procedural look
/// by object type and semantic surface. Surfaces without semantics get one by their normal.
struct SurfaceLook {
    LookKind kind = LookKind::Solid;
    std::uint32_t building = 0;  ///< index into SurfaceLooks::buildings()
    glm::vec3 colour{0.6F};
    glm::vec3 tint{1.0F};  ///< what a texture is multiplied with
    glm::vec3 emission{0.0F};
    glm::vec3 normal{0.0F, 0.0F, 1.0F};  ///< unit, of the surface as a whole
    bool planar = false;                 ///< all its triangles lie in one plane (within 5 cm)
    bool rectangular = false;       ///< a façade that fills its extent: no window can be cut off
    glm::vec2 tangent{1.0F, 0.0F};  ///< of a façade: unit, horizontal, along the wall
    std::uint32_t wall = 0;         ///< of a façade: the wall that it is part of
    float uMin = 0.0F;              ///< of a façade: where its wall starts along the tangent
    float width = 0.0F;             ///< of a façade: metres; 0 = one of many small pieces
    float bottom = 0.0F;            ///< lowest and highest z
    float top = 0.0F;
};

/// What all surfaces of one building (or tree, or other root object) share.
struct BuildingLook {
    std::uint32_t seed = 0;
    float base = 0.0F;  ///< lowest and highest z of the whole object
    float top = 0.0F;
    glm::vec2 center{0.0F};    ///< of its extent
    float radius = 0.0F;       ///< half of its larger horizontal extent
    bool hasOpenings = false;  ///< windows or doors are modelled
    bool inPieces = false;     ///< its walls are cut into pieces smaller than a window bay
};

/// Calls visit with each corner of a triangle.
template <class Visit>
void eachVertex(const CityModel& city, std::size_t triangle, const Visit& visit) {
    for (const std::uint32_t v : city.triangles[triangle].vertex) {
        if (v < city.vertices.size() && std::isfinite(glm::length(city.vertices[v]))) {
            visit(city.vertices[v]);
        }
    }
}

/// The looks of all surfaces of a city, and the triangles of each.
class SurfaceLooks {
public:
    /// Of no use when the job was cancelled on the way.
    explicit SurfaceLooks(const CityModel& city, const JobContext& job = {});

    [[nodiscard]] const SurfaceLook& surface(std::size_t index) const { return m_surfaces[index]; }
    [[nodiscard]] const BuildingLook& building(std::size_t index) const {
        return m_buildings[index];
    }
    /// Indices of the triangles of a surface.
    [[nodiscard]] std::pair<const std::uint32_t*, const std::uint32_t*> triangles(
        std::size_t surface) const {
        return {m_triangles.data() + m_first[surface], m_triangles.data() + m_first[surface + 1]};
    }
    /// Indices of the triangles of the wall that a façade's surface is part of.
    [[nodiscard]] std::pair<const std::uint32_t*, const std::uint32_t*> wallTriangles(
        std::size_t surface) const {
        const std::uint32_t wall = m_surfaces[surface].wall;
        return {m_wallTriangles.data() + m_firstOfWall[wall],
                m_wallTriangles.data() + m_firstOfWall[wall + 1]};
    }

private:
    void indexTriangles(const CityModel& city);
    void gatherBuildings(const CityModel& city);
    void measureSurfaces(const CityModel& city);
    void measureSurface(const CityModel& city, std::size_t i);
    void chooseLooks(const CityModel& city);
    void layOutFacades(const CityModel& city, const JobContext& job);
    void joinWalls(const CityModel& city);
    void layOutWall(const CityModel& city, const std::vector<std::uint32_t>& members);

    std::vector<SurfaceLook> m_surfaces;
    std::vector<BuildingLook> m_buildings;  ///< one per object; only those of roots are filled
    std::vector<std::uint32_t> m_root;      ///< per object
    std::vector<std::uint32_t> m_first;     ///< per surface, into m_triangles
    std::vector<std::uint32_t> m_triangles;
    std::vector<float> m_area;                 ///< per surface
    std::vector<std::uint32_t> m_firstOfWall;  ///< per wall, into m_wallTriangles
    std::vector<std::uint32_t> m_wallTriangles;
    std::vector<std::vector<std::uint32_t>> m_walls;  ///< surfaces of each wall
};

}  // namespace reflet
