// SPDX-License-Identifier: GPL-3.0-or-later
#include "BoxCity.h"

#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet::test {

namespace {

double fraction(double value) {
    return value - std::floor(value);
}

/// Houses: walls with windows 3 m apart; roofs with ridges; ground with a grid of slabs.
glm::vec3 surfaceColour(const glm::dvec3& p, bool wall, bool alongX, double height) {
    if (wall) {
        const double along = alongX ? p.x : p.y;
        const bool window = fraction(along / 3.0) > 0.3 && fraction(along / 3.0) < 0.75 &&
                            fraction(p.z / 3.2) > 0.25 && fraction(p.z / 3.2) < 0.8;
        if (window)
            return {0.05f, 0.08f, 0.12f};
        const double tint = fraction(height * 0.37 + 0.13 * std::floor(along / 12.0));
        return {float(0.45 + 0.3 * tint), float(0.4 + 0.2 * tint), float(0.35 - 0.1 * tint)};
    }
    if (height > 0.0)
        return {0.4f, 0.18f, 0.12f};
    const bool seam = fraction(p.x / 2.0) < 0.1 || fraction(p.y / 2.0) < 0.1;
    const float shade = std::abs(p.y) < 5.0 ? 0.12f : 0.3f;
    return glm::vec3(seam ? 0.5f * shade : shade);
}

glm::vec3 skyColour(const glm::dvec3& direction) {
    const double up = direction.z / glm::length(direction);
    return {float(0.55 - 0.25 * up), float(0.65 - 0.15 * up), float(0.85)};
}

}  // namespace

BoxCity::BoxCity(double x0, double y0, int columns, int rows, double cellSize) {
    m_field.grid = {x0, y0, cellSize, columns, rows};
    m_field.ground.assign(m_field.grid.cellCount(), 0.0f);
    m_field.topMax = m_field.ground;
    m_field.topCenter = m_field.ground;
}

void BoxCity::addBox(double x0, double y0, double x1, double y1, float height) {
    const GridSpec& grid = m_field.grid;
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            const double x = grid.xMin(i) + 0.5 * grid.cellSize;
            const double y = grid.yMin(j) + 0.5 * grid.cellSize;
            if (x < x0 || x >= x1 || y < y0 || y >= y1)
                continue;
            float& top = m_field.topMax[grid.index(i, j)];
            top = std::max(top, height);
            m_field.topCenter[grid.index(i, j)] = top;
        }
    }
}

glm::vec3 BoxCity::radiance(const Ray& ray) const {
    const GridSpec& grid = m_field.grid;
    const HeightfieldHit hit = traceReference(grid, m_field.topCenter, ray);
    if (!hit.hit)
        return skyColour(ray.direction);
    const glm::dvec3 p = ray.at(hit.t);
    const double height = m_field.topCenter[grid.index(hit.i, hit.j)];
    const bool wall = p.z < height - 1e-6;
    const double toXBorder =
        std::min(std::abs(p.x - grid.xMin(hit.i)), std::abs(p.x - grid.xMin(hit.i + 1)));
    const double toYBorder =
        std::min(std::abs(p.y - grid.yMin(hit.j)), std::abs(p.y - grid.yMin(hit.j + 1)));
    return surfaceColour(p, wall, toYBorder < toXBorder, height);
}

ReferenceEnvironmentMap BoxCity::see(std::string id, const glm::dvec3& center, int resolution,
                                     int samples) const {
    ReferenceEnvironmentMap map{std::move(id), center, CubeMap<glm::vec3>(resolution),
                                CubeMap<float>(resolution)};
    const auto rows = std::size_t(resolution);
    parallelFor(0, 6 * rows, 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t line = first; line < last; ++line) {
            const int face = int(line / rows);
            const int row = int(line % rows);
            for (int column = 0; column < resolution; ++column) {
                const Ray middle{center, texelDirection(resolution, face, column, row)};
                const HeightfieldHit hit = traceReference(m_field.grid, m_field.topCenter, middle);
                map.distance.at(face, column, row) =
                    hit.hit ? float(hit.t * glm::length(middle.direction)) : kInfinity;
                glm::dvec3 sum(0.0);
                const int fine = resolution * samples;
                for (int j = 0; j < samples; ++j) {
                    for (int i = 0; i < samples; ++i) {
                        const glm::dvec3 d =
                            texelDirection(fine, face, column * samples + i, row * samples + j);
                        sum += glm::dvec3(radiance({center, d}));
                    }
                }
                map.radiance.at(face, column, row) = glm::vec3(sum / double(samples * samples));
            }
        }
    });
    return map;
}

BoxCity streetCity() {
    BoxCity city(-80.0, -60.0, 160, 120, 1.0);
    int house = 0;
    for (double x = -80.0; x < 80.0; x += 16.0, ++house) {
        const double gap = house % 4 == 3 ? 6.0 : 0.0;  // a side street after every fourth house
        const auto height = float(9 + (house * 7) % 11);
        city.addBox(x, 9.0, x + 16.0 - gap, 27.0, height);
        if (x < 16.0 || x > 40.0)
            city.addBox(x, -30.0, x + 16.0 - gap, -11.0, float(8 + (house * 5) % 13));
    }
    city.addBox(10.0, -60.0, 60.0, -50.0, 18.0f);  // the far side of the square
    for (double x = -70.0; x < 80.0; x += 20.0)
        city.addBox(x, 6.0, x + 1.0, 7.0, 5.0f);
    return city;
}

ReferenceEnvironmentMap coordinateMap(std::string id, const glm::dvec3& center, int resolution,
                                      float distance) {
    ReferenceEnvironmentMap map =
        plainMap(std::move(id), center, resolution, glm::vec3(1.0f), distance);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < resolution; ++row) {
            for (int column = 0; column < resolution; ++column) {
                map.radiance.at(face, column, row) = {float(texelCoordinate(resolution, column)),
                                                      float(texelCoordinate(resolution, row)),
                                                      1.0f};
            }
        }
    }
    return map;
}

ReferenceEnvironmentMap plainMap(std::string id, const glm::dvec3& center, int resolution,
                                 const glm::vec3& radiance, float distance) {
    return {std::move(id), center, CubeMap<glm::vec3>(resolution, radiance),
            CubeMap<float>(resolution, distance)};
}

}  // namespace reflet::test
