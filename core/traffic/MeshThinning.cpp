// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/MeshThinning.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace reflet {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
constexpr float kLeastTurn = 0.94F;  // cosine: how far a triangle may turn in one step (20 degrees)
constexpr int kPasses = 4;

struct PositionHash {
    std::size_t operator()(const std::array<float, 3>& p) const {
        std::uint64_t h = 0;
        for (const float f : p)
            h = (h ^ std::uint64_t(std::hash<float>()(f))) * 0x9e3779b97f4a7c15ULL;
        return std::size_t(h ^ (h >> 31U));
    }
};

/// Removes vertices one by one: v moves onto a neighbour u and the triangles between them go.
class Thinner {
public:
    Thinner(PartMesh& mesh, float error)
        : m_mesh(mesh),
          m_error(error),
          m_around(mesh.positions.size()),
          m_strayed(mesh.positions.size(), 0.0F) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            for (int k = 0; k < 3; ++k)
                m_around[mesh.triangles[i][k]].push_back(std::uint32_t(i));
        }
        lockCreases();
    }

    void run() {
        for (int pass = 0; pass < kPasses; ++pass) {
            std::size_t removed = 0;
            for (std::uint32_t v = 0; v < m_around.size(); ++v)
                removed += !m_locked[v] && tryRemove(v) ? 1 : 0;
            if (removed * 50 < m_around.size())
                return;
        }
    }

private:
    struct Neighbour {
        std::uint32_t vertex = 0;
        std::uint16_t material = 0;
        int triangles = 0;
        bool border = false;  // triangles of two materials meet in the edge
    };

    /// Vertices that share their place with others lie on a crease; what happens to one would have
    /// to happen to all.
    void lockCreases() {
        m_locked.assign(m_mesh.positions.size(), false);
        std::unordered_map<std::array<float, 3>, std::uint32_t, PositionHash> seen;
        seen.reserve(m_mesh.positions.size());
        for (std::uint32_t v = 0; v < m_mesh.positions.size(); ++v) {
            const glm::vec3& p = m_mesh.positions[v];
            const auto [first, isNew] = seen.try_emplace({p.x, p.y, p.z}, v);
            if (!isNew)
                m_locked[v] = m_locked[first->second] = true;
        }
    }

    /// The neighbours of v; false when v lies on an open edge, or where more than two surfaces
    /// meet.
    bool findNeighbours(std::uint32_t v) {
        m_neighbours.clear();
        for (const std::uint32_t i : m_around[v]) {
            const glm::uvec3& t = m_mesh.triangles[i];
            for (int k = 0; k < 3; ++k) {
                if (t[k] == v)
                    continue;
                auto known = std::find_if(m_neighbours.begin(), m_neighbours.end(),
                                          [&](const Neighbour& n) { return n.vertex == t[k]; });
                if (known == m_neighbours.end()) {
                    m_neighbours.push_back({t[k], m_mesh.material[i], 1, false});
                    continue;
                }
                ++known->triangles;
                known->border = known->border || known->material != m_mesh.material[i];
            }
        }
        return std::all_of(m_neighbours.begin(), m_neighbours.end(),
                           [](const Neighbour& n) { return n.triangles == 2; });
    }

    [[nodiscard]] static glm::vec3 crossOf(const glm::vec3& a, const glm::vec3& b,
                                           const glm::vec3& c) {
        return glm::cross(b - a, c - a);
    }

    /// How far the surface strays when v moves onto u; infinite when a triangle would turn over or
    /// the mesh would touch itself.
    [[nodiscard]] float strays(std::uint32_t v, std::uint32_t u) const {
        constexpr float kNever = 1e30F;
        const glm::vec3& from = m_mesh.positions[v];
        const glm::vec3& to = m_mesh.positions[u];
        float worst = 0.0F;
        for (const std::uint32_t i : m_around[v]) {
            const glm::uvec3& t = m_mesh.triangles[i];
            if (t.x == u || t.y == u || t.z == u)
                continue;
            const int k = t.x == v ? 0 : t.y == v ? 1 : 2;
            const glm::vec3& a = m_mesh.positions[t[(k + 1) % 3]];
            const glm::vec3& b = m_mesh.positions[t[(k + 2) % 3]];
            const glm::vec3 before = crossOf(from, a, b);
            const glm::vec3 after = crossOf(to, a, b);
            const float size = glm::length(after);
            const glm::vec3 facing =
                m_mesh.normals[u] + m_mesh.normals[t[(k + 1) % 3]] + m_mesh.normals[t[(k + 2) % 3]];
            const float longest = std::max(
                {glm::dot(a - to, a - to), glm::dot(b - to, b - to), glm::dot(a - b, a - b)});
            if (size < 1e-3F * longest || glm::dot(after, facing) <= 0.0F ||
                glm::dot(before, after) < kLeastTurn * size * glm::length(before)) {
                return kNever;
            }
            worst = std::max(worst, std::abs(glm::dot(from - a, after)) / size);
        }
        return sharesOnlyTheirTriangles(u) ? worst : kNever;
    }

    /// Two vertices may be joined only if the neighbours that they share are those of the two
    /// triangles between them.
    [[nodiscard]] bool sharesOnlyTheirTriangles(std::uint32_t u) const {
        int shared = 0;
        for (const Neighbour& n : m_neighbours) {
            if (n.vertex == u)
                continue;
            const auto& around = m_around[n.vertex];
            shared += std::any_of(around.begin(), around.end(), [&](std::uint32_t i) {
                const glm::uvec3& t = m_mesh.triangles[i];
                return t.x == u || t.y == u || t.z == u;
            });
        }
        return shared <= 2;
    }

    [[nodiscard]] float fromLine(std::uint32_t v, std::uint32_t a, std::uint32_t b) const {
        const glm::vec3 line = m_mesh.positions[b] - m_mesh.positions[a];
        const float length = glm::length(line);
        const glm::vec3 away = m_mesh.positions[v] - m_mesh.positions[a];
        return length > 0.0F ? glm::length(glm::cross(away, line)) / length : m_error;
    }

    bool tryRemove(std::uint32_t v) {
        if (m_around[v].empty() || !findNeighbours(v))
            return false;
        std::array<std::uint32_t, 2> ends{};
        std::size_t borders = 0;
        for (const Neighbour& n : m_neighbours) {
            if (n.border && borders++ < 2)
                ends[borders - 1] = n.vertex;
        }
        if (borders == 1 || borders > 2)
            return false;
        const float bend = borders == 2 ? fromLine(v, ends[0], ends[1]) : 0.0F;
        const float room = m_error - m_strayed[v];
        float best = room;
        std::uint32_t target = kNone;
        for (const Neighbour& n : m_neighbours) {
            if (bend >= room || (borders == 2 && !n.border))
                continue;
            const float far = std::max(bend, strays(v, n.vertex));
            if (far < best) {
                best = far;
                target = n.vertex;
            }
        }
        if (target != kNone)
            join(v, target, m_strayed[v] + best);
        return target != kNone;
    }

    void join(std::uint32_t v, std::uint32_t u, float strayed) {
        for (const std::uint32_t i : m_around[v]) {
            glm::uvec3& t = m_mesh.triangles[i];
            if (t.x == u || t.y == u || t.z == u) {
                for (int k = 0; k < 3; ++k) {
                    if (t[k] != v)
                        std::erase(m_around[t[k]], i);
                }
                t = glm::uvec3(kNone);
                continue;
            }
            for (int k = 0; k < 3; ++k)
                t[k] = t[k] == v ? u : t[k];
            m_around[u].push_back(i);
        }
        m_around[v].clear();
        for (const Neighbour& n : m_neighbours)
            m_strayed[n.vertex] = std::max(m_strayed[n.vertex], strayed);
    }

    PartMesh& m_mesh;
    const float m_error;
    std::vector<std::vector<std::uint32_t>> m_around;  // triangles, per vertex
    std::vector<float> m_strayed;  // metres that the surface about a vertex has moved already
    std::vector<bool> m_locked;
    std::vector<Neighbour> m_neighbours;  // of the vertex that is looked at
};

/// Without the triangles that are gone and the vertices that none uses.
PartMesh compacted(const PartMesh& mesh) {
    PartMesh out;
    std::vector<std::uint32_t> index(mesh.positions.size(), kNone);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        glm::uvec3 t = mesh.triangles[i];
        if (t.x == kNone)
            continue;
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& v = index[t[k]];
            if (v == kNone) {
                v = std::uint32_t(out.positions.size());
                out.positions.push_back(mesh.positions[t[k]]);
                out.normals.push_back(mesh.normals[t[k]]);
                out.surface.push_back(mesh.surface[t[k]]);
            }
            t[k] = v;
        }
        out.triangles.push_back(t);
        out.material.push_back(mesh.material[i]);
    }
    return out;
}

}  // namespace

void thin(PartMesh& mesh, float error) {
    Thinner(mesh, error).run();
    mesh = compacted(mesh);
}

}  // namespace reflet
