// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/HeightfieldBench.h"

#include "core/baking/RayScene.h"
#include "core/base/ParallelFor.h"
#include "core/base/Stopwatch.h"
#include "core/heightfield/HeightfieldBuilder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace reflet {

namespace {

constexpr float kBlock = 20.0F;  ///< metres
constexpr int kPosts = 8;        ///< edges of the terrain along a block
constexpr int kHouses = 5;       ///< in a block
constexpr std::size_t kTrianglesOfAHouse = 12;
constexpr std::size_t kTrianglesOfABlock = 2 * kPosts * kPosts + kHouses * kTrianglesOfAHouse;

/// Relief of a few metres without a flat stretch.
float terrainHeight(float x, float y) {
    return 6.0F * std::sin(0.011F * x) * std::cos(0.013F * y) + 0.4F * std::sin(0.31F * (x + y));
}

class BlockCity {
public:
    explicit BlockCity(int blocks) : m_blocks(blocks) {}

    CityModel make() {
        addTerrain();
        for (int j = 0; j < m_blocks; ++j)
            for (int i = 0; i < m_blocks; ++i)
                for (int k = 0; k < kHouses; ++k)
                    addHouse(kBlock * (float(i) + (0.5F + float(k)) / kHouses),
                             kBlock * (float(j) + m_part(m_random)));
        return std::move(m_city);
    }

private:
    std::uint32_t addSurface(CityObjectType type, std::string id) {
        CityObject object;
        object.id = std::move(id);
        object.type = type;
        m_city.surfaces.push_back({std::uint32_t(m_city.objects.size())});
        m_city.objects.push_back(std::move(object));
        return std::uint32_t(m_city.surfaces.size() - 1);
    }

    std::uint32_t addVertex(const glm::vec3& v) {
        m_city.vertices.push_back(v);
        return std::uint32_t(m_city.vertices.size() - 1);
    }

    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t surface) {
        m_city.triangles.push_back({{a, b, c}, surface});
    }

    void addTerrain() {
        const std::uint32_t surface = addSurface(CityObjectType::TinRelief, "terrain");
        const int edges = m_blocks * kPosts;
        const float step = kBlock / kPosts;
        for (int j = 0; j <= edges; ++j)
            for (int i = 0; i <= edges; ++i) {
                const float x = step * float(i), y = step * float(j);
                addVertex({x, y, terrainHeight(x, y)});
            }
        const auto at = [&](int i, int j) { return std::uint32_t(j * (edges + 1) + i); };
        for (int j = 0; j < edges; ++j)
            for (int i = 0; i < edges; ++i) {
                addTriangle(at(i, j), at(i + 1, j), at(i + 1, j + 1), surface);
                addTriangle(at(i, j), at(i + 1, j + 1), at(i, j + 1), surface);
            }
    }

    /// Four walls, a roof of two slopes, two gables: turned anyhow.
    void addHouse(float x, float y) {
        const std::uint32_t surface =
            addSurface(CityObjectType::Building, fmt::format("house-{}", m_city.objects.size()));
        const float turn = 6.28F * m_part(m_random);
        const glm::vec2 along(std::cos(turn), std::sin(turn));
        const glm::vec2 across(-along.y, along.x);
        const float base = terrainHeight(x, y);
        const float eaves = base + 3.0F + 12.0F * m_part(m_random);
        const auto corner = [&](float u, float v, float z) {
            const glm::vec2 p = glm::vec2(x, y) + 2.0F * u * along + 3.0F * v * across;
            return addVertex({p, z});
        };
        std::array<std::uint32_t, 4> low{}, high{};
        constexpr std::array<glm::vec2, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
        for (std::size_t k = 0; k < 4; ++k) {
            low[k] = corner(kCorners[k].x, kCorners[k].y, base);
            high[k] = corner(kCorners[k].x, kCorners[k].y, eaves);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t next = (k + 1) % 4;
            addTriangle(low[k], low[next], high[next], surface);
            addTriangle(low[k], high[next], high[k], surface);
        }
        const std::uint32_t ridge = corner(0.0F, 0.0F, eaves + 2.0F);
        for (std::size_t k = 0; k < 4; ++k)
            addTriangle(high[k], high[(k + 1) % 4], ridge, surface);
    }

    int m_blocks;
    CityModel m_city;
    std::mt19937 m_random{1};
    std::uniform_real_distribution<float> m_part{0.1F, 0.9F};
};

/// Heights that rays from above read at the cells' centres; -infinity where they meet nothing.
std::vector<float> rayHeights(const RayScene& scene, const GridSpec& grid, float above) {
    std::vector<float> heights(grid.cellCount());
    const auto columns = std::size_t(grid.columns);
    parallelFor(0, std::size_t(grid.rows), 8, [&](std::size_t first, std::size_t last) {
        std::vector<glm::vec3> origins(columns);
        const std::vector<glm::vec3> down(columns, glm::vec3(0.0F, 0.0F, -1.0F));
        std::vector<SceneHit> hits(columns);
        for (std::size_t j = first; j < last; ++j) {
            for (std::size_t i = 0; i < columns; ++i)
                origins[i] = {grid.xMin(int(i)) + 0.5 * grid.cellSize,
                              grid.yMin(int(j)) + 0.5 * grid.cellSize, above};
            scene.intersect(origins, down, std::numeric_limits<float>::infinity(), hits);
            for (std::size_t i = 0; i < columns; ++i)
                heights[j * columns + i] = above - hits[i].distance;
        }
    });
    return heights;
}

}  // namespace

CityModel blockCity(std::size_t triangles) {
    const double blocks = std::sqrt(double(triangles) / double(kTrianglesOfABlock));
    return BlockCity(std::max(1, int(blocks))).make();
}

Result<HeightfieldBenchReport> benchHeightfield(std::size_t triangles, double cellSize,
                                                const JobContext& job) {
    const CityModel city = blockCity(triangles);
    HeightfieldSettings settings;
    settings.cellSize = cellSize;
    const auto grid = gridFor(city, settings);
    if (!grid)
        return tl::unexpected(grid.error());
    HeightfieldBenchReport report;
    report.triangles = city.triangles.size();
    report.cells = grid->cellCount();

    const Stopwatch building;
    const auto field = buildHeightfield(city, *grid, job.phase("heightfield", 0.0, 0.4));
    if (!field)
        return tl::unexpected(field.error());
    report.ours = building.seconds();

    const Stopwatch tracing;
    const auto scene = RayScene::build(city, {}, job.phase("rays", 0.4, 0.9));
    if (!scene)
        return tl::unexpected(scene.error());
    const auto rays = rayHeights(**scene, *grid, float(city.bounds().max.z) + 1.0F);
    report.reference = tracing.seconds();

    std::size_t low = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
        low += !isMissing(field->topMax[i]) && rays[i] < field->topMax[i] - 1.0F ? 1 : 0;
    report.tooLow = double(low) / double(rays.size());
    return report;
}

}  // namespace reflet
