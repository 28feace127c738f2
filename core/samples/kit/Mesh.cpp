// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Mesh.h"

#include <cmath>

namespace reflet::kit {

namespace {

/// Twice the area vector (Newell), square millimetres.
glm::dvec3 areaVector(std::span<const glm::ivec3> ring) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec3 a(ring[i] - ring[0]);
        const glm::dvec3 b(ring[(i + 1) % ring.size()] - ring[0]);
        sum += glm::cross(a, b);
    }
    return sum;
}

}  // namespace

void Mesh::polygon(std::span<const glm::dvec3> ring, Skin skin) {
    const auto first = m_points.size();
    for (const glm::dvec3& p : ring) {
        const glm::ivec3 snapped(glm::round(p * 1000.0));
        if (m_points.size() == first || m_points.back() != snapped) {
            m_points.push_back(snapped);
        }
    }
    while (m_points.size() > first + 1 && m_points.back() == m_points[first]) {
        m_points.pop_back();
    }
    const std::size_t count = m_points.size() - first;
    constexpr double kLeastArea = 2.0 * 4.0;  // 4 mm²: below this a polygon is a scratch
    if (count < 3 || glm::length(areaVector({m_points.data() + first, count})) < kLeastArea) {
        m_points.resize(first);
        return;
    }
    m_faces.push_back({std::uint32_t(first), std::uint32_t(count), skin});
    m_triangles += count - 2;
}

}  // namespace reflet::kit
