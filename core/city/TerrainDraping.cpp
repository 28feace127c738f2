// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/TerrainDraping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace reflet {

namespace {

/// Heights of the terrain's triangles, found by a grid of cells.
class TerrainHeights {
public:
    explicit TerrainHeights(const CityModel& model) : m_model(model) {
        for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
            const CityTriangle& triangle = model.triangles[t];
            if (isTerrain(model.objects[model.surfaces[triangle.surface].object].type)) {
                m_triangles.push_back(t);
                for (const std::uint32_t vertex : triangle.vertex)
                    m_box.add(glm::dvec3(model.vertices[vertex]));
            }
        }
        if (!m_triangles.empty())
            sortIntoCells();
    }

    [[nodiscard]] bool empty() const { return m_triangles.empty(); }

    /// The highest surface there; NaN where there is none.
    [[nodiscard]] double at(double x, double y) const {
        double height = std::numeric_limits<double>::quiet_NaN();
        if (!(x >= m_box.min.x && x <= m_box.max.x && y >= m_box.min.y && y <= m_box.max.y))
            return height;
        const std::size_t cell = column(x) + m_columns * row(y);
        for (std::uint32_t i = m_begin[cell]; i < m_begin[cell + 1]; ++i) {
            const double z = heightIn(m_inCells[i], x, y);
            if (std::isnan(height) || z > height)
                height = z;
        }
        return height;
    }

private:
    [[nodiscard]] std::size_t column(double x) const {
        return std::min(m_columns - 1, std::size_t((x - m_box.min.x) / m_cell));
    }
    [[nodiscard]] std::size_t row(double y) const {
        return std::min(m_rows - 1, std::size_t((y - m_box.min.y) / m_cell));
    }

    /// Cells of the size of a triangle, on the average; a counting sort.
    void sortIntoCells() {
        constexpr std::size_t kMostAcross = 4096;
        const glm::dvec3 size = m_box.size();
        const double area = std::max(size.x * size.y, 1.0);
        m_cell = std::max({std::sqrt(area / double(m_triangles.size())),
                           std::max(size.x, size.y) / double(kMostAcross), 1e-3});
        m_columns = std::size_t(size.x / m_cell) + 1;
        m_rows = std::size_t(size.y / m_cell) + 1;
        m_begin.assign(m_columns * m_rows + 1, 0);
        forAllCells([&](std::uint32_t, std::size_t cell) { ++m_begin[cell + 1]; });
        for (std::size_t i = 1; i < m_begin.size(); ++i)
            m_begin[i] += m_begin[i - 1];
        m_inCells.resize(m_begin.back());
        std::vector<std::uint32_t> next(m_begin.begin(), m_begin.end() - 1);
        forAllCells([&](std::uint32_t t, std::size_t cell) { m_inCells[next[cell]++] = t; });
    }

    template <class Visit>
    void forAllCells(const Visit& visit) const {
        for (const std::uint32_t t : m_triangles) {
            Box box;
            for (const std::uint32_t vertex : m_model.triangles[t].vertex)
                box.add(glm::dvec3(m_model.vertices[vertex]));
            for (std::size_t j = row(box.min.y); j <= row(box.max.y); ++j) {
                for (std::size_t i = column(box.min.x); i <= column(box.max.x); ++i)
                    visit(t, i + m_columns * j);
            }
        }
    }

    [[nodiscard]] double heightIn(std::uint32_t t, double x, double y) const {
        const auto& v = m_model.triangles[t].vertex;
        const glm::dvec3 a(m_model.vertices[v[0]]), b(m_model.vertices[v[1]]),
            c(m_model.vertices[v[2]]);
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        const double u = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area;
        const double w = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area;
        constexpr double kOutside = -1e-9;
        if (!(u >= kOutside && w >= kOutside && u + w <= 1.0 - kOutside))
            return std::numeric_limits<double>::quiet_NaN();
        return u * a.z + w * b.z + (1.0 - u - w) * c.z;
    }

    const CityModel& m_model;
    Box m_box;
    std::vector<std::uint32_t> m_triangles;
    double m_cell = 1.0;
    std::size_t m_columns = 1, m_rows = 1;
    std::vector<std::uint32_t> m_begin;  ///< of each cell, into m_inCells
    std::vector<std::uint32_t> m_inCells;
};

std::uint32_t rootOf(const CityModel& model, std::uint32_t object) {
    while (model.objects[object].parent)
        object = *model.objects[object].parent;
    return object;
}

}  // namespace

std::size_t drapeOnTerrain(CityModel& model, std::span<const std::uint32_t> objects) {
    if (objects.empty())
        return 0;
    const TerrainHeights terrain(model);
    if (terrain.empty())
        return 0;
    std::vector<bool> aboveGround(model.objects.size(), false);
    for (const std::uint32_t object : objects)
        aboveGround[object] = true;
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    std::vector<double> lowest(model.objects.size(), kUnknown);  // of each root
    std::vector<std::uint32_t> ownerOf(model.vertices.size(), kNone);
    for (const CityTriangle& triangle : model.triangles) {
        const std::uint32_t object = model.surfaces[triangle.surface].object;
        if (!aboveGround[object])
            continue;
        const std::uint32_t root = rootOf(model, object);
        for (const std::uint32_t vertex : triangle.vertex) {
            if (ownerOf[vertex] != kNone)
                continue;
            ownerOf[vertex] = root;
            const glm::vec3& p = model.vertices[vertex];
            const double z = terrain.at(double(p.x), double(p.y));
            if (z < lowest[root])
                lowest[root] = z;
        }
    }
    for (std::size_t v = 0; v < ownerOf.size(); ++v) {
        if (ownerOf[v] != kNone && lowest[ownerOf[v]] != kUnknown)
            model.vertices[v].z += float(lowest[ownerOf[v]]);
    }
    return std::size_t(std::count_if(objects.begin(), objects.end(), [&](std::uint32_t object) {
        return lowest[rootOf(model, object)] != kUnknown;
    }));
}

}  // namespace reflet
