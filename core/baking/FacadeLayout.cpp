// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/SurfaceLook.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace reflet {

namespace {

constexpr float kSamePlane = 0.3F;     ///< metres between the planes of one wall's surfaces
constexpr float kSameHeading = 0.05F;  ///< radians between their headings
constexpr float kSmallPiece = 4.0F;    ///< square metres: less than a bay

/// Of the two horizontal tangents the one towards the east, whatever the winding. What counts as
/// east is turned a little, so that walls along the axes do not flip by their noise.
glm::vec2 tangentOf(const glm::vec3& normal) {
    glm::vec2 tangent(-normal.y, normal.x);
    tangent /= std::max(glm::length(tangent), 1e-6F);
    const glm::vec2 east(0.927F, 0.375F);
    return glm::dot(tangent, east) < 0.0F ? -tangent : tangent;
}

/// Building, heading and place of a wall.
using WallKey = std::array<std::int64_t, 3>;
struct HashOfWall {
    std::size_t operator()(const WallKey& key) const {
        std::uint64_t h = 0;
        for (const std::int64_t part : key) {
            h = (h ^ std::uint64_t(part)) * 0x9e3779b97f4a7c15ULL;
            h ^= h >> 32;
        }
        return h;
    }
};

}  // namespace

/// Surfaces of one building that lie in one upright plane make one wall: many cities deliver each
/// wall as loose triangles, and a window must not end where a triangle does.
void SurfaceLooks::joinWalls(const CityModel& city) {
    std::unordered_map<WallKey, std::uint32_t, HashOfWall> wallOf;
    wallOf.reserve(m_surfaces.size() / 2);
    for (std::size_t i = 0; i < m_surfaces.size(); ++i) {
        SurfaceLook& look = m_surfaces[i];
        if (look.kind != LookKind::Facade) {
            continue;
        }
        look.tangent = tangentOf(look.normal);
        const glm::vec2 across(-look.tangent.y, look.tangent.x);
        // Measured from the building's centre, so that rounding does not grow with the city.
        const auto [begin, end] = triangles(i);
        if (begin == end) {
            continue;
        }
        const glm::vec2 place(city.vertices[city.triangles[*begin].vertex[0]]);
        const float offset = glm::dot(place - m_buildings[look.building].center, across);
        const float heading = std::atan2(look.tangent.y, look.tangent.x);
        const WallKey key{look.building, std::llround(heading / kSameHeading),
                          std::llround(offset / kSamePlane)};
        const auto [found, isNew] = wallOf.try_emplace(key, std::uint32_t(m_walls.size()));
        if (isNew) {
            m_walls.emplace_back();
        }
        look.wall = found->second;
        m_walls[look.wall].push_back(std::uint32_t(i));
    }
    m_firstOfWall.assign(1, 0);
    for (const auto& members : m_walls) {
        for (const std::uint32_t surface : members) {
            const auto [first, last] = triangles(surface);
            m_wallTriangles.insert(m_wallTriangles.end(), first, last);
        }
        m_firstOfWall.push_back(std::uint32_t(m_wallTriangles.size()));
    }
}

/// All surfaces of a wall share its tangent, extent and heights.
void SurfaceLooks::layOutWall(const CityModel& city, const std::vector<std::uint32_t>& members) {
    const auto largest = std::max_element(members.begin(), members.end(),
                                          [&](auto a, auto b) { return m_area[a] < m_area[b]; });
    const glm::vec2 tangent = m_surfaces[*largest].tangent;
    float from = std::numeric_limits<float>::max();
    float to = std::numeric_limits<float>::lowest();
    float bottom = from;
    float top = to;
    float area = 0.0F;
    for (const std::uint32_t surface : members) {
        area += m_area[surface];
        bottom = std::min(bottom, m_surfaces[surface].bottom);
        top = std::max(top, m_surfaces[surface].top);
        const auto [begin, end] = triangles(surface);
        for (const auto* t = begin; t != end; ++t) {
            eachVertex(city, *t, [&](const glm::vec3& p) {
                const float u = p.x * tangent.x + p.y * tangent.y;
                from = std::min(from, u);
                to = std::max(to, u);
            });
        }
    }
    for (const std::uint32_t surface : members) {
        SurfaceLook& look = m_surfaces[surface];
        look.tangent = tangent;
        look.uMin = from;
        look.width = to - from;
        look.bottom = bottom;
        look.top = top;
        look.rectangular = area > 0.97F * look.width * (top - bottom);
    }
}

void SurfaceLooks::layOutFacades(const CityModel& city, const JobContext& job) {
    joinWalls(city);
    if (job.cancelled())
        return;
    std::vector<std::array<float, 2>> areas(m_buildings.size());  // of small walls, of all walls
    for (const auto& members : m_walls) {
        layOutWall(city, members);
        float area = 0.0F;
        for (const std::uint32_t surface : members) {
            area += m_area[surface];
        }
        auto& [small, all] = areas[m_surfaces[members.front()].building];
        small += area < kSmallPiece ? area : 0.0F;
        all += area;
    }
    for (std::size_t i = 0; i < m_buildings.size(); ++i) {
        m_buildings[i].inPieces = areas[i][0] * 2.0F > areas[i][1];
    }
    for (SurfaceLook& look : m_surfaces) {
        if (look.kind == LookKind::Facade && m_buildings[look.building].inPieces) {
            look.uMin = 0.0F;
            look.width = 0.0F;
            look.bottom = m_buildings[look.building].base;
            look.top = m_buildings[look.building].top;
            look.rectangular = true;
        }
    }
}

}  // namespace reflet
