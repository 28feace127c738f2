// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/SurfaceLook.h"

#include "core/baking/Pattern.h"
#include "core/base/ParallelFor.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>

namespace reflet {

namespace {

constexpr int kMaxAncestors = 64;
constexpr float kUpright = 0.5F;  ///< |n.z| below this is a wall

std::uint32_t seedOf(std::string_view id) {
    std::uint32_t h = 2166136261U;  // FNV-1a
    for (const char c : id) {
        h = (h ^ std::uint32_t(static_cast<unsigned char>(c))) * 16777619U;
    }
    return patternHash(h);
}

bool startsWith(std::string_view text, std::string_view prefix) {
    return text.size() >= prefix.size() &&
           std::equal(prefix.begin(), prefix.end(), text.begin(), [](char a, char b) {
               return a == char(std::tolower(static_cast<unsigned char>(b)));
           });
}

/// A colour from a file, made safe: components within the range, never NaN.
glm::vec3 soundColour(const glm::vec3& colour, float limit) {
    glm::vec3 result;
    for (int i = 0; i < 3; ++i) {
        result[i] = std::isfinite(colour[i]) ? std::clamp(colour[i], 0.0F, limit) : 0.0F;
    }
    return result;
}

bool isBuilding(CityObjectType type) {
    return type == CityObjectType::Building || type == CityObjectType::BuildingPart;
}

/// Twice the area times the unit normal; zero for triangles that do not exist.
glm::dvec3 crossOf(const CityModel& city, std::size_t triangle) {
    const auto& v = city.triangles[triangle].vertex;
    const std::size_t n = city.vertices.size();
    if (v[0] >= n || v[1] >= n || v[2] >= n) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 a(city.vertices[v[0]]);
    const glm::dvec3 cross =
        glm::cross(glm::dvec3(city.vertices[v[1]]) - a, glm::dvec3(city.vertices[v[2]]) - a);
    return std::isfinite(glm::length(cross)) ? cross : glm::dvec3(0.0);
}

/// The semantic surface, told by the normal where the file is silent. Winding cannot be trusted,
/// so that a level surface is a roof or a floor by where it lies in the object.
SurfaceType surfaceType(const CitySurface& surface, const SurfaceLook& look,
                        const BuildingLook& building) {
    if (surface.type != SurfaceType::Unknown && surface.type != SurfaceType::Other) {
        return surface.type;
    }
    if (std::abs(look.normal.z) < kUpright) {
        return SurfaceType::Wall;
    }
    const float middle = 0.5F * (building.base + building.top);
    return 0.5F * (look.bottom + look.top) < middle ? SurfaceType::Ground : SurfaceType::Roof;
}

glm::vec3 pick(std::uint32_t seed, std::initializer_list<std::uint32_t> palette) {
    return colourOf(*(palette.begin() + patternHash(seed) % palette.size()));
}

glm::vec3 plasterColour(std::uint32_t seed) {
    return pick(seed ^ 0x51U, {0xE6D9BD, 0xD8B982, 0xDDBBA6, 0xCB9A7F, 0xCFCABF, 0xE9E3D4, 0xD5C5A0,
                               0xE5CF9F, 0xA9705A, 0xB9BFBE, 0xDCC9B4, 0xC9B48E});
}

glm::vec3 roofColour(std::uint32_t seed, bool flat) {
    if (flat) {
        return pick(seed ^ 0x17U, {0x9A968D, 0x86847F, 0xA8A397, 0x77777A, 0x8F8578});
    }
    return pick(seed ^ 0x23U, {0xB26A4C, 0xA55E43, 0xBA7655, 0x9C5A45, 0x656A72, 0x7A6058});
}

/// The look by object type and semantic surface when neither texture nor material says anything.
void proceduralLook(const CityObject& object, SurfaceType type, const BuildingLook& building,
                    SurfaceLook& look) {
    const bool level = std::abs(look.normal.z) >= kUpright;
    const auto set = [&](LookKind kind, std::uint32_t srgb) {
        look.kind = kind;
        look.colour = colourOf(srgb);
    };
    if (type == SurfaceType::Water || object.type == CityObjectType::WaterBody) {
        return set(LookKind::Water, 0x3F6670);
    }
    if (type == SurfaceType::Window) {
        return set(LookKind::Solid, 0x3A4A57);
    }
    if (type == SurfaceType::Door) {
        return set(LookKind::Solid, 0x5B4433);
    }
    switch (object.type) {
        case CityObjectType::Road:
            if (!level) {
                return set(LookKind::Stone, 0xA9A69E);
            }
            return type == SurfaceType::AuxiliaryTrafficArea ? set(LookKind::Slabs, 0xB5B0A6)
                                                             : set(LookKind::Asphalt, 0x7A7774);
        case CityObjectType::Railway:
            return set(LookKind::Asphalt, 0x7D766E);
        case CityObjectType::TransportSquare:
            return level ? set(LookKind::Paving, 0xC2B8A5) : set(LookKind::Stone, 0xB3AA9A);
        case CityObjectType::LandUse:
        case CityObjectType::PlantCover:
            return set(LookKind::Grass, 0x6F8A4B);
        case CityObjectType::TinRelief:
            return object.id == "reflet-generated-ground" ? set(LookKind::Asphalt, 0x8E8C89)
                                                          : set(LookKind::Earth, 0x8D8B72);
        case CityObjectType::SolitaryVegetation:
            return set(LookKind::Foliage, 0x5F7D42);
        case CityObjectType::CityFurniture:
            return set(LookKind::Solid, 0x4A4F4E);
        case CityObjectType::Building:
        case CityObjectType::BuildingPart:
        case CityObjectType::BuildingInstallation:
            break;
        default:
            return set(LookKind::Stone, level ? 0xA39D92 : 0xB0A99C);
    }
    if (type == SurfaceType::Roof || (type == SurfaceType::Closure && level)) {
        const bool flat = std::abs(look.normal.z) > 0.97F;
        look.kind = flat ? LookKind::FlatRoof : LookKind::TiledRoof;
        look.colour = roofColour(building.seed, flat);
        return;
    }
    const bool storeys = isBuilding(object.type) && !building.hasOpenings && !level &&
                         (type == SurfaceType::Wall || type == SurfaceType::Closure);
    look.kind = storeys ? LookKind::Facade : LookKind::Plaster;
    look.colour = plasterColour(building.seed);
}

}  // namespace

SurfaceLooks::SurfaceLooks(const CityModel& city, const JobContext& job)
    : m_surfaces(city.surfaces.size()),
      m_buildings(city.objects.size() + 1),
      m_root(city.objects.size()),
      m_area(city.surfaces.size(), 0.0F) {
    indexTriangles(city);
    if (!job.cancelled())
        gatherBuildings(city);
    if (!job.cancelled())
        measureSurfaces(city);
    if (!job.cancelled())
        chooseLooks(city);
    if (!job.cancelled())
        layOutFacades(city, job);
}

void SurfaceLooks::indexTriangles(const CityModel& city) {
    m_first.assign(city.surfaces.size() + 1, 0);
    for (const CityTriangle& t : city.triangles) {
        if (t.surface < city.surfaces.size()) {
            ++m_first[t.surface + 1];
        }
    }
    for (std::size_t i = 1; i < m_first.size(); ++i) {
        m_first[i] += m_first[i - 1];
    }
    m_triangles.resize(m_first.back());
    std::vector<std::uint32_t> next(m_first.begin(), m_first.end() - 1);
    for (std::size_t i = 0; i < city.triangles.size(); ++i) {
        const std::uint32_t surface = city.triangles[i].surface;
        if (surface < city.surfaces.size()) {
            m_triangles[next[surface]++] = std::uint32_t(i);
        }
    }
}

void SurfaceLooks::gatherBuildings(const CityModel& city) {
    const auto count = std::uint32_t(city.objects.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        m_root[i] = i;
        for (int step = 0; step < kMaxAncestors; ++step) {
            const auto& parent = city.objects[m_root[i]].parent;
            if (!parent || *parent >= count || *parent == m_root[i] ||
                city.objects[*parent].type == CityObjectType::Group) {
                break;
            }
            m_root[i] = *parent;
        }
    }
    std::vector<Box> bounds(count + 1);
    for (const CityTriangle& t : city.triangles) {
        if (t.surface >= city.surfaces.size()) {
            continue;
        }
        const CitySurface& surface = city.surfaces[t.surface];
        const std::uint32_t root = surface.object < count ? m_root[surface.object] : count;
        const std::size_t index = std::size_t(&t - city.triangles.data());
        eachVertex(city, index, [&](const glm::vec3& p) { bounds[root].add(glm::dvec3(p)); });
        m_buildings[root].hasOpenings |=
            surface.type == SurfaceType::Window || surface.type == SurfaceType::Door;
    }
    for (std::uint32_t i = 0; i <= count; ++i) {
        BuildingLook& building = m_buildings[i];
        building.seed = i < count ? seedOf(city.objects[i].id) : 0;
        if (!bounds[i].empty()) {
            building.base = float(bounds[i].min.z);
            building.top = float(bounds[i].max.z);
            building.center = glm::vec2(bounds[i].center());
            building.radius = 0.5F * float(std::max(bounds[i].size().x, bounds[i].size().y));
        }
    }
}

void SurfaceLooks::measureSurfaces(const CityModel& city) {
    constexpr std::size_t kGrain = 1024;
    parallelFor(0, m_surfaces.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            measureSurface(city, i);
    });
}

void SurfaceLooks::measureSurface(const CityModel& city, std::size_t i) {
    SurfaceLook& look = m_surfaces[i];
    look.bottom = std::numeric_limits<float>::max();
    look.top = std::numeric_limits<float>::lowest();
    glm::dvec3 sum(0.0);
    double area = 0.0;
    const auto [begin, end] = triangles(i);
    for (const auto* t = begin; t != end; ++t) {
        const glm::dvec3 cross = crossOf(city, *t);
        // Pieces that face opposite ways (bad winding) must not cancel out.
        sum += glm::dot(sum, cross) < 0.0 ? -cross : cross;
        area += 0.5 * glm::length(cross);
        eachVertex(city, *t, [&](const glm::vec3& p) {
            look.bottom = std::min(look.bottom, p.z);
            look.top = std::max(look.top, p.z);
        });
    }
    m_area[i] = float(area);
    const double length = glm::length(sum);
    if (!(length > 0.0)) {
        return;
    }
    const glm::dvec3 normal = sum / length;
    look.normal = glm::vec3(normal);
    const glm::dvec3 anchor(city.vertices[city.triangles[*begin].vertex[0]]);
    look.planar = true;
    for (const auto* t = begin; t != end; ++t) {
        eachVertex(city, *t, [&](const glm::vec3& p) {
            look.planar &= std::abs(glm::dot(normal, glm::dvec3(p) - anchor)) < 0.05;
        });
    }
}

void SurfaceLooks::chooseLooks(const CityModel& city) {
    const auto none = std::uint32_t(city.objects.size());
    static const CityObject unknown;
    for (std::size_t i = 0; i < m_surfaces.size(); ++i) {
        const CitySurface& surface = city.surfaces[i];
        SurfaceLook& look = m_surfaces[i];
        const bool owned = surface.object < none;
        look.building = owned ? m_root[surface.object] : none;
        const CityObject& object = owned ? city.objects[surface.object] : unknown;
        const BuildingLook& building = m_buildings[look.building];
        const SurfaceType type = surfaceType(surface, look, building);
        proceduralLook(object, type, building, look);
        if (surface.material >= city.materials.size()) {
            continue;
        }
        const CityMaterial& material = city.materials[surface.material];
        look.colour = soundColour(material.diffuse, 1.0F);
        look.tint = soundColour(material.tint, 1.0F);
        look.emission = soundColour(material.emission, 1e4F);
        const bool tints = material.name.empty() || startsWith(material.name, "facade");
        if (look.kind != LookKind::Facade || !tints) {
            look.kind = LookKind::Solid;
        }
    }
}

}  // namespace reflet
