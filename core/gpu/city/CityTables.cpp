// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityTables.h"

#include "core/baking/Facade.h"

#include <bit>
#include <cmath>
#include <map>

namespace reflet {

namespace {

/// Gables of more triangles are taken as whole walls, as on the CPU.
constexpr std::ptrdiff_t kMaxTrianglesOfAGable = 64;

std::uint32_t bits(float value) {
    return std::bit_cast<std::uint32_t>(value);
}
TableTexel texel(float a, float b, float c, float d) {
    return {bits(a), bits(b), bits(c), bits(d)};
}
TableTexel texel(const glm::vec3& v, std::uint32_t d) {
    return {bits(v.x), bits(v.y), bits(v.z), d};
}
TableTexel texel(const glm::vec3& v, float d) {
    return texel(v, bits(d));
}

std::uint32_t flagsOf(const SurfaceLook& look, const FacadeStyle& s) {
    return (s.modern ? 1U : 0U) | (s.shops ? 2U : 0U) | (s.awnings ? 4U : 0U) |
           (s.shutters ? 8U : 0U) | (s.rusticated ? 16U : 0U) | (look.rectangular ? 32U : 0U);
}

/// Where the triangles of a gable's wall lie in mesh.walls.
struct WallRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

class FacadeWriter {
public:
    FacadeWriter(const DrawnCity& city, CityMesh& mesh) : m_city(city), m_mesh(mesh) {}

    void add(std::uint32_t surface) {
        const SurfaceLook& look = m_city.looks->surface(surface);
        const BuildingLook& building = m_city.looks->building(look.building);
        const FacadeStyle s = facadeStyle(look, building);
        const FacadeGrid g = facadeGrid(look, building, s);
        const WallRange wall = look.rectangular ? WallRange{} : wallOf(surface);
        auto& out = m_mesh.facades;
        out.push_back(texel(look.tangent.x, look.tangent.y, look.uMin, g.bay));
        out.push_back({bits(building.base), bits(look.bottom - building.base),
                       bits(look.top - building.base), flagsOf(look, s)});
        out.push_back(texel(g.firstBay, g.lastBay, s.window, s.height));
        out.push_back(texel(s.sill, s.surround, s.frame, s.groundStorey));
        out.push_back(texel(s.storey, g.firstStorey, g.lastStorey, g.courses));
        out.push_back(texel(g.firstGround, g.lastGround, g.doorBay, g.margin));
        out.push_back(texel(s.wall, building.seed));
        out.push_back(texel(s.trim, wall.first));
        out.push_back(texel(s.frameColour, wall.count));
        out.push_back(texel(s.shutter, 0U));
        out.push_back(texel(s.plinth, 0U));
        out.push_back(texel(doorColour(building), 0U));
    }

private:
    WallRange wallOf(std::uint32_t surface) {
        const SurfaceLook& look = m_city.looks->surface(surface);
        const auto [begin, end] = m_city.looks->wallTriangles(surface);
        if (end - begin > kMaxTrianglesOfAGable) {
            return {};
        }
        const auto [found, isNew] = m_walls.try_emplace(look.wall);
        if (isNew) {
            found->second = {std::uint32_t(m_mesh.walls.size() / 2), std::uint32_t(end - begin)};
            for (const auto* t = begin; t != end; ++t) {
                glm::vec2 corner[3];
                for (std::size_t i = 0; i < 3; ++i) {
                    const glm::vec3& v =
                        m_city.model->vertices[m_city.model->triangles[*t].vertex[i]];
                    corner[i] = {v.x * look.tangent.x + v.y * look.tangent.y, v.z};
                }
                m_mesh.walls.push_back(texel(corner[0].x, corner[0].y, corner[1].x, corner[1].y));
                m_mesh.walls.push_back(texel(corner[2].x, corner[2].y, 0.0F, 0.0F));
            }
        }
        return found->second;
    }

    const DrawnCity& m_city;
    CityMesh& m_mesh;
    std::map<std::uint32_t, WallRange> m_walls;
};

}  // namespace

ShadeKind shadeKind(const SurfaceLook& look, bool textured) {
    if (textured) {
        return ShadeKind::Textured;
    }
    switch (look.kind) {
        case LookKind::Solid:
            return ShadeKind::Plain;
        case LookKind::Facade:
            return ShadeKind::Facade;
        case LookKind::Slabs:
        case LookKind::Paving:
        case LookKind::TiledRoof:
            return ShadeKind::Joints;
        default:
            return ShadeKind::Ground;
    }
}

void fillSurfaceTables(const DrawnCity& city, const std::vector<ShadeKind>& kinds, CityMesh& mesh) {
    FacadeWriter facades(city, mesh);
    mesh.surfaces.reserve(kSurfaceTexels * (kinds.size() + 1));
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        const SurfaceLook& look = city.looks->surface(i);
        const BuildingLook& building = city.looks->building(look.building);
        const auto facade = std::uint32_t(mesh.facades.size() / kFacadeTexels);
        if (kinds[i] == ShadeKind::Facade) {
            facades.add(i);
        }
        mesh.surfaces.push_back(texel(look.colour, std::uint32_t(look.kind)));
        mesh.surfaces.push_back(texel(look.emission, building.seed));
        mesh.surfaces.push_back(
            texel(building.base, building.top, building.center.x, building.center.y));
        mesh.surfaces.push_back({facade, 0U, 0U, 0U});
        mesh.surfaces.push_back(kinds[i] == ShadeKind::Textured
                                    ? mesh.textures.places[city.model->surfaces[i].texture]
                                    : TableTexel(0U));
    }
    mesh.surfaces.push_back(texel(Appearance{}.albedo, std::uint32_t(LookKind::Solid)));
    mesh.surfaces.insert(mesh.surfaces.end(), kSurfaceTexels - 1, TableTexel(0U));
}

void addTriangle(const CityModel& city, std::uint32_t triangle, ShadeKind kind,
                 const PartScale& scale, CityMesh& mesh) {
    const CityTriangle& t = city.triangles[triangle];
    const glm::dvec3 a(city.vertices[t.vertex[0]]);
    const glm::dvec3 edge1 = glm::dvec3(city.vertices[t.vertex[1]]) - a;
    const glm::dvec3 edge2 = glm::dvec3(city.vertices[t.vertex[2]]) - a;
    const glm::dvec3 normal = glm::normalize(glm::cross(edge1, edge2));
    const auto surface =
        std::min(t.surface, std::uint32_t(city.surfaces.size()));  // the last is "unknown"
    mesh.triangles.push_back(texel(glm::vec3(normal), surface));
    mesh.triangles.push_back(texel(scale(glm::vec3(a)), 0U));
    if (kind != ShadeKind::Textured) {
        return;
    }
    // Barycentric coordinates of a point a + w of the plane are w·g1 and w·g2 (normal equations).
    const double d11 = glm::dot(edge1, edge1);
    const double d12 = glm::dot(edge1, edge2);
    const double d22 = glm::dot(edge2, edge2);
    const double determinant = d11 * d22 - d12 * d12;
    const glm::dvec3 g1 = (d22 * edge1 - d12 * edge2) / determinant;
    const glm::dvec3 g2 = (d11 * edge2 - d12 * edge1) / determinant;
    const auto& uv = city.uv[triangle];
    const bool repeat = city.textures[city.surfaces[t.surface].texture].repeat;
    for (int axis = 0; axis < 2; ++axis) {
        const double at = uv[0][axis];
        const glm::dvec3 gradient =
            (double(uv[1][axis]) - at) * g1 + (double(uv[2][axis]) - at) * g2;
        mesh.mapping.push_back(
            texel(glm::vec3(gradient), float(repeat ? at - std::floor(at) : at)));
    }
}

}  // namespace reflet
