// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightfieldBuilder.h"

#include "core/base/ParallelFor.h"
#include "core/heightfield/TerrainTin.h"
#include "core/heightfield/TriangleRaster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace reflet {

namespace {

/// Triangles between two looks at progress; pieces of them between two looks at the stop token.
constexpr std::size_t kBatch = 1U << 16U;
constexpr std::size_t kGrain = 128;
constexpr std::size_t kRowGrain = 4;
/// A triangle over more cells than this is shared out by rows.
constexpr double kManyCells = 65536.0;

/// Which layers a triangle of the city raises.
struct Role {
    bool top = false;
    bool ground = false;
};

Role roleOf(const CityModel& city, const CityTriangle& triangle) {
    const CitySurface& surface = city.surfaces[triangle.surface];
    if (surface.type == SurfaceType::Closure) {
        return {};
    }
    if (isTerrain(city.objects[surface.object].type)) {
        return {true, true};
    }
    return {surface.type != SurfaceType::Ground, false};
}

TriangleCorners cornersOf(const CityModel& city, const CityTriangle& triangle) {
    return {glm::dvec3(city.vertices[triangle.vertex[0]]),
            glm::dvec3(city.vertices[triangle.vertex[1]]),
            glm::dvec3(city.vertices[triangle.vertex[2]])};
}

bool isFinite(const TriangleCorners& corners) {
    const glm::dvec3 zero = 0.0 * (corners[0] + corners[1] + corners[2]);
    return zero == glm::dvec3(0.0);
}

double cellsUnder(const GridPlan& plan, const TriangleCorners& corners, CellRange rows) {
    const auto [low, high] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const CellRange columns = touchedCells(plan.columns, low, high);
    return double(rows.last - rows.first) * double(columns.last - columns.first);
}

/// Hands the triangles [0, count) to raise(n, corners, rows): most of them in parallel with one
/// another, large ones one by one with their rows in parallel. cornersAt(n) gives a triangle.
template <class CornersAt, class Raise>
class Rasterizer {
public:
    Rasterizer(const GridPlan& plan, const CornersAt& cornersAt, const Raise& raise,
               const JobContext& job)
        : m_plan(plan), m_cornersAt(cornersAt), m_raise(raise), m_job(job) {}

    /// False when the job was cancelled on the way.
    bool run(std::size_t count) {
        for (std::size_t begin = 0; begin < count && !m_job.cancelled(); begin += kBatch) {
            const std::size_t end = std::min(count, begin + kBatch);
            const std::vector<char> large = raiseSmall(begin, end);
            for (std::size_t n = begin; n < end && !m_job.cancelled(); ++n) {
                if (large[n - begin] != 0) {
                    raiseLarge(n);
                }
            }
            m_job.progress(double(end) / double(count));
        }
        return !m_job.cancelled();
    }

private:
    /// Says for each triangle of [begin, end) whether it was too large and is left to do.
    std::vector<char> raiseSmall(std::size_t begin, std::size_t end) {
        std::vector<char> large(end - begin, 0);
        parallelFor(begin, end, kGrain, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last && !m_job.cancelled(); ++n) {
                const TriangleCorners corners = m_cornersAt(n);
                if (!isFinite(corners)) {
                    continue;
                }
                const CellRange rows = touchedRows(m_plan, corners);
                if (cellsUnder(m_plan, corners, rows) > kManyCells) {
                    large[n - begin] = 1;
                } else {
                    m_raise(n, corners, rows);
                }
            }
        });
        return large;
    }

    void raiseLarge(std::size_t n) {
        const TriangleCorners corners = m_cornersAt(n);
        const CellRange rows = touchedRows(m_plan, corners);
        parallelFor(std::size_t(rows.first), std::size_t(rows.last), kRowGrain,
                    [&](std::size_t first, std::size_t last) {
                        if (!m_job.cancelled()) {
                            m_raise(n, corners, {int(first), int(last)});
                        }
                    });
    }

    const GridPlan& m_plan;
    const CornersAt& m_cornersAt;
    const Raise& m_raise;
    const JobContext& m_job;
};

struct Layers {
    RisingLayer topMax;
    RisingLayer topCenter;
    RisingLayer ground;

    explicit Layers(const GridSpec& grid) : topMax(grid), topCenter(grid), ground(grid) {}
};

bool rasterizeCity(const CityModel& city, const GridPlan& plan, Layers& layers,
                   const JobContext& job) {
    const auto cornersAt = [&](std::size_t n) { return cornersOf(city, city.triangles[n]); };
    const auto raise = [&](std::size_t n, const TriangleCorners& corners, CellRange rows) {
        const Role role = roleOf(city, city.triangles[n]);
        if (role.top) {
            raiseMaximum(layers.topMax, plan, corners, rows);
            raiseCenters(layers.topCenter, plan, corners, rows);
        }
        if (role.ground) {
            raiseCenters(layers.ground, plan, corners, rows);
        }
    };
    return Rasterizer(plan, cornersAt, raise, job).run(city.triangles.size());
}

std::vector<glm::dvec3> terrainPoints(const CityModel& city) {
    std::vector<char> used(city.vertices.size(), 0);
    for (const CityTriangle& triangle : city.triangles) {
        if (roleOf(city, triangle).ground && isFinite(cornersOf(city, triangle))) {
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

/// Heights across the holes of the terrain: the Delaunay triangles of all its vertices, whatever
/// the grid, so that neighbouring tiles agree.
Result<void> fillGround(const CityModel& city, const GridPlan& plan, RisingLayer& fill,
                        const JobContext& job) {
    const auto faces = delaunayFromAbove(terrainPoints(city), job.phase("terrain", 0.0, 0.8));
    if (!faces) {
        return tl::unexpected(faces.error());
    }
    const auto cornersAt = [&](std::size_t n) { return (*faces)[n]; };
    const auto raise = [&](std::size_t, const TriangleCorners& corners, CellRange rows) {
        raiseCenters(fill, plan, corners, rows);
    };
    const JobContext raising = job.phase("terrain", 0.8, 1.0);
    if (!Rasterizer(plan, cornersAt, raise, raising).run(faces->size())) {
        return tl::unexpected(JobContext::cancelledError());
    }
    return {};
}

/// Gives each cell the fallbacks that Heightfield's contract names, and -infinity back its name.
Heightfield finished(const GridSpec& grid, Layers& layers, const std::vector<float>& fill) {
    Heightfield field{grid, std::move(layers.ground.heights()), std::move(layers.topMax.heights()),
                      std::move(layers.topCenter.heights())};
    const auto named = [](float height) { return height == -kInfinity ? kMissingHeight : height; };
    parallelFor(0, grid.cellCount(), 1U << 16U, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            float& ground = field.ground[n];
            float& center = field.topCenter[n];
            ground = ground == -kInfinity ? fill[n] : ground;
            center = center == -kInfinity ? ground : center;
            field.topMax[n] = named(std::max(field.topMax[n], center));
            center = named(center);
            ground = named(ground);
        }
    });
    return field;
}

Result<Heightfield> build(const CityModel& city, const GridSpec& grid, const JobContext& job) {
    const GridPlan plan(grid, city.frame);
    Layers layers(grid);
    if (!rasterizeCity(city, plan, layers, job.phase("heights", 0.0, 0.6))) {
        return tl::unexpected(JobContext::cancelledError());
    }
    RisingLayer fill(grid);
    const std::vector<float>& ground = layers.ground.heights();
    if (std::find(ground.begin(), ground.end(), -kInfinity) == ground.end()) {
        return finished(grid, layers, fill.heights());  // no hole to fill
    }
    if (const auto filled = fillGround(city, plan, fill, job.phase("ground", 0.6, 1.0)); !filled) {
        return tl::unexpected(filled.error());
    }
    return finished(grid, layers, fill.heights());
}

}  // namespace

Result<Heightfield> buildHeightfield(const CityModel& city, const GridSpec& grid,
                                     const JobContext& job) {
    if (!(grid.cellSize > 0.0) || grid.columns <= 0 || grid.rows <= 0) {
        return fail(ErrorCode::Usage, "the grid has no cells", "heightfield",
                    "Give a positive cell size and at least one column and row");
    }
    try {
        return build(city, grid, job);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("no memory for {} x {} cells", grid.columns, grid.rows),
                    "heightfield", "Take larger cells or close other programs");
    }
}

}  // namespace reflet
