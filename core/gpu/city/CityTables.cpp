// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityTables.h"

#include "core/baking/Facade.h"
#include "core/base/ParallelFor.h"

#include <bit>
#include <cmath>

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

/// Where the triangles of a gable's wall lie in mesh.walls; none for a wall without.
struct WallRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Whether two surfaces of a wall are drawn by the same record.
bool looksAlike(const SurfaceLook& a, const SurfaceLook& b) {
    return a.building == b.building && a.colour == b.colour && a.tangent == b.tangent &&
           a.uMin == b.uMin && a.width == b.width && a.bottom == b.bottom && a.top == b.top &&
           a.rectangular == b.rectangular;
}

/// Which record each façade has: the surfaces of a wall share one where they look alike.
class FacadeNumbers {
public:
    FacadeNumbers(const DrawnCity& city, CityMesh& mesh) : m_city(city), m_mesh(mesh) {}

    std::uint32_t of(std::uint32_t surface) {
        const SurfaceLook& look = m_city.looks->surface(surface);
        if (look.wall >= m_walls.size()) {
            m_walls.resize(std::size_t(look.wall) + 1);
        }
        Wall& wall = m_walls[look.wall];
        if (wall.record == kNone || !looksAlike(look, m_city.looks->surface(wall.surface))) {
            if (!look.rectangular && wall.triangles.count == 0) {
                wall.triangles = addTriangles(surface);
            }
            wall.surface = surface;
            wall.record = std::uint32_t(m_records.size());
            m_records.push_back({surface, look.rectangular ? WallRange{} : wall.triangles});
        }
        return wall.record;
    }

    /// A surface that is drawn by a record, and the triangles of its gable.
    struct Record {
        std::uint32_t surface = 0;
        WallRange wall;
    };
    [[nodiscard]] const std::vector<Record>& records() const { return m_records; }

private:
    struct Wall {
        std::uint32_t record = kNone;
        std::uint32_t surface = 0;  ///< that the record was made for
        WallRange triangles;
    };

    WallRange addTriangles(std::uint32_t surface) {
        const SurfaceLook& look = m_city.looks->surface(surface);
        const auto [begin, end] = m_city.looks->wallTriangles(surface);
        if (end - begin > kMaxTrianglesOfAGable) {
            return {};
        }
        const WallRange range{std::uint32_t(m_mesh.walls.size() / 2), std::uint32_t(end - begin)};
        for (const auto* t = begin; t != end; ++t) {
            glm::vec2 corner[3];
            for (std::size_t i = 0; i < 3; ++i) {
                const glm::vec3& v = m_city.model->vertices[m_city.model->triangles[*t].vertex[i]];
                corner[i] = {v.x * look.tangent.x + v.y * look.tangent.y, v.z};
            }
            m_mesh.walls.push_back(texel(corner[0].x, corner[0].y, corner[1].x, corner[1].y));
            m_mesh.walls.push_back(texel(corner[2].x, corner[2].y, 0.0F, 0.0F));
        }
        return range;
    }

    const DrawnCity& m_city;
    CityMesh& m_mesh;
    std::vector<Wall> m_walls;
    std::vector<Record> m_records;
};

void writeFacade(const SurfaceLooks& looks, const FacadeNumbers::Record& record, TableTexel* out) {
    const SurfaceLook& look = looks.surface(record.surface);
    const BuildingLook& building = looks.building(look.building);
    const FacadeStyle s = facadeStyle(look, building);
    const FacadeGrid g = facadeGrid(look, building, s);
    *out++ = texel(look.tangent.x, look.tangent.y, look.uMin, g.bay);
    *out++ = {bits(building.base), bits(look.bottom - building.base),
              bits(look.top - building.base), flagsOf(look, s)};
    *out++ = texel(g.firstBay, g.lastBay, s.window, s.height);
    *out++ = texel(s.sill, s.surround, s.frame, s.groundStorey);
    *out++ = texel(s.storey, g.firstStorey, g.lastStorey, g.courses);
    *out++ = texel(g.firstGround, g.lastGround, g.doorBay, g.margin);
    *out++ = texel(s.wall, building.seed);
    *out++ = texel(s.trim, record.wall.first);
    *out++ = texel(s.frameColour, record.wall.count);
    *out++ = texel(s.shutter, 0U);
    *out++ = texel(s.plinth, 0U);
    *out++ = texel(doorColour(building), 0U);
}

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
    const SurfaceLooks& looks = *city.looks;
    FacadeNumbers facades(city, mesh);
    std::vector<std::uint32_t> facadeOf(kinds.size());
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        facadeOf[i] = kinds[i] == ShadeKind::Facade ? facades.of(i) : 0;
    }
    mesh.facades.resize(kFacadeTexels * facades.records().size());
    mesh.surfaces.resize(kSurfaceTexels * (kinds.size() + 1), TableTexel(0U));
    constexpr std::size_t kGrain = 1024;
    parallelFor(0, facades.records().size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            writeFacade(looks, facades.records()[n], &mesh.facades[kFacadeTexels * n]);
        }
    });
    parallelFor(0, kinds.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const SurfaceLook& look = looks.surface(i);
            const BuildingLook& building = looks.building(look.building);
            TableTexel* out = &mesh.surfaces[kSurfaceTexels * i];
            out[0] = texel(look.colour, std::uint32_t(look.kind));
            out[1] = texel(look.emission, building.seed);
            out[2] = texel(building.base, building.top, building.center.x, building.center.y);
            out[3] = {facadeOf[i], bits(look.tint.x), bits(look.tint.y), bits(look.tint.z)};
            if (kinds[i] == ShadeKind::Textured) {
                out[4] = mesh.textures.places[city.model->surfaces[i].texture];
            }
        }
    });
    mesh.surfaces[kSurfaceTexels * kinds.size()] =
        texel(Appearance{}.albedo, std::uint32_t(LookKind::Solid));
}

void writeTriangle(const CityModel& city, std::uint32_t triangle, ShadeKind kind,
                   const PartScale& scale, std::size_t number, CityMesh& mesh) {
    const CityTriangle& t = city.triangles[triangle];
    const glm::dvec3 a(city.vertices[t.vertex[0]]);
    const glm::dvec3 edge1 = glm::dvec3(city.vertices[t.vertex[1]]) - a;
    const glm::dvec3 edge2 = glm::dvec3(city.vertices[t.vertex[2]]) - a;
    const glm::dvec3 normal = glm::normalize(glm::cross(edge1, edge2));
    const auto surface =
        std::min(t.surface, std::uint32_t(city.surfaces.size()));  // the last is "unknown"
    mesh.triangles[2 * number] = texel(glm::vec3(normal), surface);
    mesh.triangles[2 * number + 1] = texel(scale(glm::vec3(a)), 0U);
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
        mesh.mapping[2 * (number - mesh.firstTextured) + std::size_t(axis)] =
            texel(glm::vec3(gradient), float(repeat ? at - std::floor(at) : at));
    }
}

}  // namespace reflet
