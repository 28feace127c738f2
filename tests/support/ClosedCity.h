// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <map>
#include <utility>

namespace reflet::test {

/// Edges of triangles that are not those of one other triangle, the other way round: 0 for closed
/// solids.
[[nodiscard]] inline std::size_t openEdges(const CityModel& city) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const CityTriangle& triangle : city.triangles) {
        for (std::size_t k = 0; k < 3; ++k)
            ++edges[{triangle.vertex[k], triangle.vertex[(k + 1) % 3]}];
    }
    std::size_t open = 0;
    for (const auto& [edge, count] : edges) {
        const auto other = edges.find({edge.second, edge.first});
        open += other == edges.end() || other->second != count ? 1 : 0;
    }
    return open;
}

/// Of all closed solids together, by the divergence theorem: positive when they look outward.
[[nodiscard]] inline double volume(const CityModel& city) {
    double sum = 0.0;
    for (const CityTriangle& triangle : city.triangles) {
        const glm::dvec3 a(city.vertices[triangle.vertex[0]]), b(city.vertices[triangle.vertex[1]]),
            c(city.vertices[triangle.vertex[2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
}

}  // namespace reflet::test
