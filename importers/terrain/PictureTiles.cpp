// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/terrain/PictureTiles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace reflet::terrain {

namespace {

using Polygon = std::vector<std::uint32_t>;  ///< vertices of the city

class Layer {
public:
    Layer(CityModel& city, const PictureGrid& grid, const PictureSource& source)
        : m_city(city), m_grid(grid), m_source(source) {
        m_city.uv.resize(m_city.triangles.size());
    }

    void add(std::uint32_t triangle) {
        const CityTriangle whole = m_city.triangles[triangle];
        const auto uv = m_city.uv[triangle];
        m_replaced = triangle;
        m_isReplaced = false;
        const Polygon polygon(whole.vertex.begin(), whole.vertex.end());
        if (!touches(polygon))
            return;
        for (auto& [column, strip] : split(polygon, 0, m_grid.columns))
            for (auto& [row, piece] : split(strip, 1, m_grid.rows))
                keep(piece, column, row, whole.surface);
        if (!m_isReplaced) {  // cut to nothing by rounding
            m_city.triangles[triangle] = whole;
            m_city.uv[triangle] = uv;
        }
    }

private:
    /// Index of the strip, -1 before the first line and `count` behind the last.
    using Strip = std::pair<int, Polygon>;

    [[nodiscard]] double line(int axis, int number) const {
        return m_grid.min[axis] + number * m_grid.tileSize()[axis];
    }
    [[nodiscard]] double coordinate(std::uint32_t vertex, int axis) const {
        return double(m_city.vertices[vertex][axis]);
    }
    [[nodiscard]] std::pair<double, double> extent(const Polygon& polygon, int axis) const {
        double low = coordinate(polygon.front(), axis);
        double high = low;
        for (const std::uint32_t v : polygon) {
            low = std::min(low, coordinate(v, axis));
            high = std::max(high, coordinate(v, axis));
        }
        return {low, high};
    }
    [[nodiscard]] bool touches(const Polygon& polygon) const {
        for (int axis = 0; axis < 2; ++axis) {
            const auto [low, high] = extent(polygon, axis);
            const int count = axis == 0 ? m_grid.columns : m_grid.rows;
            if (high <= line(axis, 0) || low >= line(axis, count))
                return false;
        }
        return true;
    }

    std::vector<Strip> split(Polygon polygon, int axis, int count) {
        std::vector<Strip> strips;
        for (int k = 0; k <= count && !polygon.empty(); ++k) {
            const auto [low, high] = extent(polygon, axis);
            if (low >= line(axis, k))
                continue;
            if (high <= line(axis, k)) {
                strips.emplace_back(k - 1, std::move(polygon));
                return strips;
            }
            auto [below, above] = cut(polygon, axis, k);
            strips.emplace_back(k - 1, std::move(below));
            polygon = std::move(above);
        }
        if (!polygon.empty())
            strips.emplace_back(count, std::move(polygon));
        return strips;
    }

    std::pair<Polygon, Polygon> cut(const Polygon& polygon, int axis, int number) {
        const double at = line(axis, number);
        Polygon below;
        Polygon above;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const std::uint32_t p = polygon[k];
            const std::uint32_t q = polygon[(k + 1) % polygon.size()];
            const double zp = coordinate(p, axis);
            const double zq = coordinate(q, axis);
            if (zp <= at)
                below.push_back(p);
            if (zp >= at)
                above.push_back(p);
            if ((zp < at && zq > at) || (zp > at && zq < at)) {
                const std::uint32_t born = between(p, q, axis, number);
                below.push_back(born);
                above.push_back(born);
            }
        }
        return {std::move(below), std::move(above)};
    }

    /// The same vertex for both triangles of an edge: lines are met in the same order from both.
    std::uint32_t between(std::uint32_t p, std::uint32_t q, int axis, int number) {
        const auto [low, high] = std::minmax(p, q);
        const auto next = std::uint32_t(m_city.vertices.size());
        const auto [place, isNew] = m_born.try_emplace({low, high, axis, number}, next);
        if (isNew) {
            const glm::dvec3 a(m_city.vertices[low]);
            const glm::dvec3 b(m_city.vertices[high]);
            const double at = line(axis, number);
            glm::dvec3 born = a + (at - a[axis]) / (b[axis] - a[axis]) * (b - a);
            born[axis] = at;
            m_city.vertices.emplace_back(born);
        }
        return place->second;
    }

    void keep(const Polygon& polygon, int column, int row, std::uint32_t surface) {
        const bool inside = column >= 0 && column < m_grid.columns && row >= 0 && row < m_grid.rows;
        const std::uint32_t owner = inside ? surfaceOf(surface, column, row) : surface;
        for (std::size_t k = 2; k < polygon.size(); ++k) {
            const CityTriangle piece{{polygon[0], polygon[k - 1], polygon[k]}, owner};
            std::array<glm::vec2, 3> uv{glm::vec2(0.0F), glm::vec2(0.0F), glm::vec2(0.0F)};
            for (std::size_t c = 0; inside && c < 3; ++c)
                uv[c] = uvOf(piece.vertex[c], column, row);
            if (!m_isReplaced) {
                m_isReplaced = true;
                m_city.triangles[m_replaced] = piece;
                m_city.uv[m_replaced] = uv;
            } else {
                m_city.triangles.push_back(piece);
                m_city.uv.push_back(uv);
            }
        }
    }

    [[nodiscard]] glm::dvec2 tileMin(int column, int row) const {
        return m_grid.min + m_grid.tileSize() * glm::dvec2(column, row) -
               double(PictureGrid::kRim) * m_grid.pixel;
    }
    [[nodiscard]] glm::dvec2 textureSize() const {
        return m_grid.tileSize() + 2.0 * PictureGrid::kRim * m_grid.pixel;
    }
    [[nodiscard]] glm::vec2 uvOf(std::uint32_t vertex, int column, int row) const {
        const glm::dvec2 p(m_city.vertices[vertex]);
        return glm::vec2((p - tileMin(column, row)) / textureSize());
    }

    std::uint32_t surfaceOf(std::uint32_t surface, int column, int row) {
        const auto next = std::uint32_t(m_city.surfaces.size());
        const auto [place, isNew] = m_surfaces.try_emplace({surface, column, row}, next);
        if (isNew) {
            CitySurface textured = m_city.surfaces[surface];
            textured.texture = textureOf(column, row);
            m_city.surfaces.push_back(textured);
        }
        return place->second;
    }

    std::uint32_t textureOf(int column, int row) {
        const auto next = std::uint32_t(m_city.textures.size());
        const auto [place, isNew] = m_textures.try_emplace({column, row}, next);
        if (isNew) {
            PictureWindow window;
            window.crs = m_source.crs;
            window.min = tileMin(column, row) - m_source.shift;
            window.max = window.min + textureSize();
            window.width = PictureGrid::kWidth + 2 * PictureGrid::kRim;
            window.height = PictureGrid::kHeight + 2 * PictureGrid::kRim;
            m_city.textures.push_back({m_source.file, m_source.file, false, std::move(window)});
        }
        return place->second;
    }

    CityModel& m_city;
    const PictureGrid& m_grid;
    const PictureSource& m_source;
    std::map<std::tuple<std::uint32_t, std::uint32_t, int, int>, std::uint32_t> m_born;
    std::map<std::tuple<std::uint32_t, int, int>, std::uint32_t> m_surfaces;
    std::map<std::pair<int, int>, std::uint32_t> m_textures;
    std::uint32_t m_replaced = 0;  ///< the triangle whose place the first piece takes
    bool m_isReplaced = false;
};

}  // namespace

PictureGrid tileGrid(const glm::dvec2& min, const glm::dvec2& max, double pixel,
                     std::size_t mostTiles) {
    PictureGrid grid;
    grid.min = min;
    grid.pixel = pixel;
    const glm::dvec2 size = max - min;
    const auto fit = [&] {
        grid.columns = std::max(1, int(std::ceil(size.x / grid.tileSize().x)));
        grid.rows = std::max(1, int(std::ceil(size.y / grid.tileSize().y)));
        return std::size_t(grid.columns) * std::size_t(grid.rows) <= mostTiles;
    };
    // At once near the size that the areas ask for: the picture may be a country's.
    const double area = PictureGrid::kWidth * double(PictureGrid::kHeight) * double(mostTiles);
    grid.pixel = std::max(pixel, std::sqrt(size.x * size.y / area));
    while (!fit())
        grid.pixel *= 1.02;
    return grid;
}

void layOn(CityModel& city, const std::vector<std::uint32_t>& triangles, const PictureGrid& grid,
           const PictureSource& source) {
    Layer layer(city, grid, source);
    for (const std::uint32_t t : triangles)
        layer.add(t);
}

}  // namespace reflet::terrain
