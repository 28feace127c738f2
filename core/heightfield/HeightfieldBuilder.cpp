// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightfieldBuilder.h"

#include "core/base/ParallelFor.h"
#include "core/heightfield/SpanBuilder.h"
#include "core/heightfield/TerrainTin.h"
#include "core/heightfield/TriangleJobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace reflet {

namespace {

/// Which layers a triangle of the city raises.
struct Role {
    bool top = false;
    bool ground = false;
    bool cover = false;
};

/// What the rules make of the surfaces of one city.
class Roles {
public:
    Roles(const CityModel& city, const HeightRules& rules) : m_city(city), m_rules(rules) {
        for (const CityTriangle& triangle : city.triangles) {
            const HeightPolicy policy = policyOf(city, rules, triangle.surface);
            m_ground = m_ground || policy == HeightPolicy::Ground;
            m_cover = m_cover || policy == HeightPolicy::Cover;
        }
    }

    [[nodiscard]] Role of(const CityTriangle& triangle) const {
        switch (policyOf(m_city, m_rules, triangle.surface)) {
            case HeightPolicy::None:
            case HeightPolicy::Tunnel:
                return {};
            case HeightPolicy::Ground:
                return {true, true, false};
            case HeightPolicy::Cover:
                return {true, !m_ground, m_ground};
            default:
                return {m_city.surfaces[triangle.surface].type != SurfaceType::Ground, false,
                        false};
        }
    }
    /// Whether some surfaces are ground only where they lie on other ground.
    [[nodiscard]] bool hasCover() const { return m_ground && m_cover; }

private:
    const CityModel& m_city;
    const HeightRules& m_rules;
    bool m_ground = false;
    bool m_cover = false;
};

struct Layers {
    RisingLayer topMax;
    RisingLayer topCenter;
    RisingLayer ground;
    RisingLayer cover;  ///< of no cells in a city without

    Layers(const GridSpec& grid, bool hasCover)
        : topMax(grid), topCenter(grid), ground(grid), cover(hasCover ? grid : GridSpec{}) {}
};

bool rasterizeCity(const CityModel& city, const GridPlan& plan, const Roles& roles, Layers& layers,
                   const JobContext& job) {
    const auto cornersAt = [&](std::size_t n) { return cornersOf(city, city.triangles[n]); };
    const auto raise = [&](std::size_t n, const TriangleCorners& corners, CellRange rows) {
        const Role role = roles.of(city.triangles[n]);
        if (role.top) {
            raiseMaximum(layers.topMax, plan, corners, rows);
            RisingLayer* below = role.ground  ? &layers.ground
                                 : role.cover ? &layers.cover
                                              : nullptr;
            raiseCenters(layers.topCenter, below, plan, corners, rows);
        }
    };
    return Rasterizer(plan, cornersAt, raise, job).run(city.triangles.size());
}

std::vector<glm::dvec3> terrainPoints(const CityModel& city, const Roles& roles) {
    std::vector<char> used(city.vertices.size(), 0);
    for (const CityTriangle& triangle : city.triangles) {
        if (roles.of(triangle).ground && isFinite(cornersOf(city, triangle))) {
            for (const std::uint32_t vertex : triangle.vertex) {
                used[vertex] = 1;
            }
        }
    }
    std::vector<glm::dvec3> points;
    for (std::size_t n = 0; n < used.size(); ++n) {
        if (used[n] != 0) {
            points.emplace_back(city.vertices[n]);
        }
    }
    return points;
}

/// Whether the triangles between those points may reach the centre of a cell without a height.
bool hasHoles(RisingLayer& ground, const GridPlan& plan, const std::vector<glm::dvec3>& points) {
    Box bounds;
    for (const glm::dvec3& point : points)
        bounds.add(point);
    const auto isWithin = [](double center, double low, double high) {
        return low <= center && center <= high;
    };
    for (int j = 0; j < plan.rows.count(); ++j) {
        if (!isWithin(plan.rows.center[std::size_t(j)], bounds.min.y, bounds.max.y))
            continue;
        for (int i = 0; i < plan.columns.count(); ++i) {
            if (ground.at(i, j) == -kInfinity &&
                isWithin(plan.columns.center[std::size_t(i)], bounds.min.x, bounds.max.x))
                return true;
        }
    }
    return false;
}

/// Heights across the holes of the terrain: the Delaunay triangles of all its vertices, whatever
/// the grid, so that neighbouring tiles agree.
Result<void> fillGround(RisingLayer& ground, const CityModel& city, const GridPlan& plan,
                        const Roles& roles, RisingLayer& fill, const JobContext& job) {
    std::vector<glm::dvec3> points = terrainPoints(city, roles);
    if (!hasHoles(ground, plan, points))
        return {};
    const auto faces = delaunayFromAbove(std::move(points), job.phase("terrain", 0.0, 0.8));
    if (!faces) {
        return tl::unexpected(faces.error());
    }
    const auto cornersAt = [&](std::size_t n) { return (*faces)[n]; };
    const auto raise = [&](std::size_t, const TriangleCorners& corners, CellRange rows) {
        raiseCenters(fill, nullptr, plan, corners, rows);
    };
    const JobContext raising = job.phase("terrain", 0.8, 1.0);
    if (!Rasterizer(plan, cornersAt, raise, raising).run(faces->size())) {
        return tl::unexpected(JobContext::cancelledError());
    }
    return {};
}

/// The ground of a cell, of what is terrain, what lies between, and what covers it.
float groundOf(float terrain, float between, float cover, double clearance) {
    const float ground = terrain == -kInfinity ? between : terrain;
    if (ground == -kInfinity) {
        return cover;
    }
    if (cover == -kInfinity || double(cover) > double(ground) + clearance) {
        return ground;
    }
    return terrain == -kInfinity ? cover : std::max(terrain, cover);
}

/// Gives each cell the fallbacks that Heightfield's contract names, and -infinity back its name.
Heightfield finished(const GridSpec& grid, Layers& layers, const std::vector<float>& fill,
                     double clearance) {
    Heightfield field;
    field.grid = grid;
    field.ground = std::move(layers.ground.heights());
    field.topMax = std::move(layers.topMax.heights());
    field.topCenter = std::move(layers.topCenter.heights());
    const std::vector<float>& covers = layers.cover.heights();
    const auto named = [](float height) { return height == -kInfinity ? kMissingHeight : height; };
    parallelFor(0, grid.cellCount(), 1U << 16U, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            float& ground = field.ground[n];
            float& center = field.topCenter[n];
            ground = groundOf(ground, fill[n], covers.empty() ? -kInfinity : covers[n], clearance);
            center = center == -kInfinity ? ground : center;
            field.topMax[n] = named(std::max(field.topMax[n], center));
            center = named(center);
            ground = named(ground);
        }
    });
    return field;
}

Result<Heightfield> build(const CityModel& city, const GridSpec& grid, const HeightRules& rules,
                          const JobContext& job) {
    const GridPlan plan(grid, city.frame);
    const Roles roles(city, rules);
    Layers layers(grid, roles.hasCover());
    if (!rasterizeCity(city, plan, roles, layers, job.phase("heights", 0.0, 0.5))) {
        return tl::unexpected(JobContext::cancelledError());
    }
    RisingLayer fill(grid);
    if (auto filled =
            fillGround(layers.ground, city, plan, roles, fill, job.phase("ground", 0.5, 0.8));
        !filled) {
        return tl::unexpected(filled.error());
    }
    Heightfield field = finished(grid, layers, fill.heights(), rules.clearance);
    if (auto spans = addSpans(field, city, rules, job.phase("overhead", 0.8, 1.0)); !spans) {
        return tl::unexpected(spans.error());
    }
    return field;
}

}  // namespace

Result<Heightfield> buildHeightfield(const CityModel& city, const GridSpec& grid,
                                     const JobContext& job) {
    return buildHeightfield(city, grid, HeightRules{}, job);
}

Result<Heightfield> buildHeightfield(const CityModel& city, const GridSpec& grid,
                                     const HeightRules& rules, const JobContext& job) {
    if (!(grid.cellSize > 0.0) || grid.columns <= 0 || grid.rows <= 0) {
        return fail(ErrorCode::Usage, "the grid has no cells", "heightfield",
                    "Give a positive cell size and at least one column and row");
    }
    try {
        return build(city, grid, rules, job);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("no memory for {} x {} cells", grid.columns, grid.rows),
                    "heightfield", "Take larger cells or close other programs");
    }
}

}  // namespace reflet
