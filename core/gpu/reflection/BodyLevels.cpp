// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/BodyLevels.h"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <cmath>
#include <cstddef>
#include <meshoptimizer.h>
#include <unordered_map>
#include <utility>

namespace reflet {

namespace {

/// Vertices that become one: of a cell, a material and a side of the cube that their normals point
/// to. Packed: 16 bits of each axis, 13 of the material, 3 of the side.
using Key = std::uint64_t;

Key cellOf(const glm::vec3& position, float cell) {
    const glm::ivec3 at(glm::floor(position / cell));
    const auto bits = [](int i) { return Key(std::uint16_t(i)); };
    return bits(at.x) << 48 | bits(at.y) << 32 | bits(at.z) << 16;
}

Key sideOf(const glm::vec3& normal) {
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return Key(2 * axis + (normal[axis] < 0.0F ? 1 : 0));
}

/// Means of what was added.
struct Mean {
    glm::vec3 sum{0.0F};
    int count = 0;
    void add(const glm::vec3& value) {
        sum += value;
        ++count;
    }
};

class Clusters {
public:
    Clusters(const BodyMesh& mesh, float cell) : m_mesh(mesh), m_cell(cell) {
        for (const BodyVertex& v : mesh.vertices)
            m_places[cellOf(v.position, cell)].add(v.position);
        m_index.reserve(mesh.vertices.size());
        for (const BodyVertex& v : mesh.vertices)
            m_index.push_back(indexOf(v));
        for (std::size_t i = 0; i < m_normals.size(); ++i) {
            const float length = glm::length(m_normals[i]);
            if (length > 0.0F)
                out.vertices[i].normal = m_normals[i] / length;
        }
    }

    std::vector<std::uint32_t> triangles(const std::vector<std::uint32_t>& from) const {
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i + 2 < from.size(); i += 3) {
            const std::uint32_t corner[] = {m_index[from[i]], m_index[from[i + 1]],
                                            m_index[from[i + 2]]};
            const auto place = [&](int k) { return out.vertices[corner[k]].position; };
            if (place(0) != place(1) && place(1) != place(2) && place(2) != place(0))
                kept.insert(kept.end(), corner, corner + 3);
        }
        return kept;
    }

    BodyMesh out;

private:
    std::uint32_t indexOf(const BodyVertex& v) {
        const Key place = cellOf(v.position, m_cell);
        const Key key = place | Key(v.material & 0x1fffU) << 3 | sideOf(v.normal);
        const auto [entry, isNew] = m_known.try_emplace(key, std::uint32_t(out.vertices.size()));
        if (isNew) {
            const Mean& mean = m_places.at(place);
            out.vertices.push_back({mean.sum / float(mean.count), v.normal, v.material});
            m_normals.emplace_back(0.0F);
        }
        m_normals[entry->second] += v.normal;
        return entry->second;
    }

    const BodyMesh& m_mesh;
    float m_cell;
    std::unordered_map<Key, Mean> m_places;
    std::unordered_map<Key, std::uint32_t> m_known;
    std::vector<std::uint32_t> m_index;  // of the vertex that each became
    std::vector<glm::vec3> m_normals;    // sums
};

}  // namespace

BodyMesh clustered(const BodyMesh& mesh, float cell) {
    Clusters clusters(mesh, cell);
    clusters.out.opaque = clusters.triangles(mesh.opaque);
    clusters.out.glass = clusters.triangles(mesh.glass);
    return std::move(clusters.out);
}

BodyMesh coarser(const BodyMesh& mesh, float error) {
    BodyMesh out = clustered(mesh, error);
    if (out.vertices.empty())
        return out;
    const float* first = &out.vertices.front().position.x;
    const std::size_t count = out.vertices.size();
    const float extent = meshopt_simplifyScale(first, count, sizeof(BodyVertex));
    for (std::vector<std::uint32_t>* indices : {&out.opaque, &out.glass}) {
        if (indices->empty() || !(extent > 0.0F))
            continue;
        std::vector<std::uint32_t> kept(indices->size());
        kept.resize(meshopt_simplify(kept.data(), indices->data(), indices->size(), first, count,
                                     sizeof(BodyVertex), 0, error / extent, 0, nullptr));
        *indices = std::move(kept);
    }
    return out;
}

}  // namespace reflet
