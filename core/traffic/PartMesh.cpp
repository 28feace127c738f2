// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/PartMesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace reflet {
namespace {

using PositionKey = std::array<std::int32_t, 3>;

struct PositionHash {
    std::size_t operator()(const PositionKey& k) const {
        std::uint64_t h = 0x9e3779b97f4a7c15U;
        for (const std::int32_t v : k) {
            h = (h ^ std::uint32_t(v)) * 0xff51afd7ed558ccdU;
            h ^= h >> 32U;
        }
        return std::size_t(h);
    }
};

PositionKey keyOf(const glm::vec3& p) {
    constexpr float kWeld = 2e-5F;  // metres
    return {std::int32_t(std::lround(p.x / kWeld)), std::int32_t(std::lround(p.y / kWeld)),
            std::int32_t(std::lround(p.z / kWeld))};
}

/// For each vertex the number of its position; equal numbers for welded vertices.
std::vector<std::uint32_t> weldedIds(const PartMesh& mesh, std::size_t& count) {
    std::unordered_map<PositionKey, std::uint32_t, PositionHash> ids;
    ids.reserve(mesh.positions.size());
    std::vector<std::uint32_t> result(mesh.positions.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] =
            ids.try_emplace(keyOf(mesh.positions[i]), std::uint32_t(ids.size())).first->second;
    }
    count = ids.size();
    return result;
}

float cornerAngle(const glm::vec3& at, const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 u = glm::normalize(a - at);
    const glm::vec3 v = glm::normalize(b - at);
    return std::acos(std::clamp(glm::dot(u, v), -1.0F, 1.0F));
}

struct Corner {
    std::uint32_t triangle = 0;
    int index = 0;
};

struct Facets {
    std::vector<glm::vec3> normal;            // unit, per triangle
    std::vector<std::array<float, 3>> angle;  // per corner
    std::vector<std::vector<Corner>> around;  // per welded position
};

/// Drops triangles without area (after welding) and measures the rest.
Facets measure(PartMesh& mesh, const std::vector<std::uint32_t>& ids, std::size_t idCount) {
    Facets facets;
    facets.around.resize(idCount);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec3 tri = mesh.triangles[t];
        const glm::vec3 p[3] = {mesh.positions[tri.x], mesh.positions[tri.y],
                                mesh.positions[tri.z]};
        const glm::vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        const bool collapsed =
            ids[tri.x] == ids[tri.y] || ids[tri.y] == ids[tri.z] || ids[tri.z] == ids[tri.x];
        if (collapsed || glm::length(cross) < 1e-12F) {
            continue;
        }
        facets.normal.push_back(glm::normalize(cross));
        std::array<float, 3> angle{};
        for (int k = 0; k < 3; ++k) {
            angle[std::size_t(k)] = cornerAngle(p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
            facets.around[ids[tri[k]]].push_back({std::uint32_t(kept), k});
        }
        facets.angle.push_back(angle);
        mesh.triangles[kept] = tri;
        mesh.material[kept] = mesh.material[t];
        ++kept;
    }
    mesh.triangles.resize(kept);
    mesh.material.resize(kept);
    return facets;
}

glm::vec3 cornerNormal(const Facets& facets, const std::vector<Corner>& around,
                       std::uint32_t triangle, float cosCrease) {
    const glm::vec3 own = facets.normal[triangle];
    glm::vec3 sum(0.0F);
    for (const Corner& c : around) {
        if (glm::dot(own, facets.normal[c.triangle]) >= cosCrease) {
            sum += facets.normal[c.triangle] * facets.angle[c.triangle][std::size_t(c.index)];
        }
    }
    const float length = glm::length(sum);
    return length > 1e-6F ? sum / length : own;
}

}  // namespace

void smoothNormals(PartMesh& mesh, float crease) {
    std::size_t idCount = 0;
    const std::vector<std::uint32_t> ids = weldedIds(mesh, idCount);
    const Facets facets = measure(mesh, ids, idCount);
    const float cosCrease = std::cos(crease);
    PartMesh result;
    result.material = mesh.material;
    // Vertices of the result that stem from the same old vertex, told apart by their normal.
    std::vector<std::vector<std::uint32_t>> made(mesh.positions.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        glm::uvec3 tri(0U);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t old = mesh.triangles[t][k];
            const glm::vec3 n =
                cornerNormal(facets, facets.around[ids[old]], std::uint32_t(t), cosCrease);
            auto& candidates = made[old];
            const auto same = std::find_if(
                candidates.begin(), candidates.end(),
                [&](std::uint32_t v) { return glm::dot(result.normals[v], n) > 0.99999F; });
            if (same != candidates.end()) {
                tri[k] = *same;
                continue;
            }
            tri[k] = std::uint32_t(result.positions.size());
            candidates.push_back(tri[k]);
            result.positions.push_back(mesh.positions[old]);
            result.normals.push_back(n);
            result.surface.push_back(mesh.surface[old]);
        }
        result.triangles.push_back(tri);
    }
    mesh = std::move(result);
}

PartMesh gridSurface(int rows, int columns, bool ring, std::uint16_t material, float crease,
                     const std::function<GridPoint(int row, int column)>& point) {
    PartMesh mesh;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const GridPoint p = point(i, j);
            mesh.positions.push_back(p.position);
            mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
            mesh.surface.push_back(p.surface);
        }
    }
    const int spans = ring ? columns : columns - 1;
    for (int i = 0; i + 1 < rows; ++i) {
        for (int j = 0; j < spans; ++j) {
            const int k = (j + 1) % columns;
            const auto a = std::uint32_t(i * columns + j);
            const auto b = std::uint32_t(i * columns + k);
            const auto c = std::uint32_t((i + 1) * columns + j);
            const auto d = std::uint32_t((i + 1) * columns + k);
            mesh.triangles.emplace_back(a, b, d);
            mesh.triangles.emplace_back(a, d, c);
            mesh.material.insert(mesh.material.end(), 2, material);
        }
    }
    smoothNormals(mesh, crease);
    return mesh;
}

void append(PartMesh& mesh, const PartMesh& other) {
    const auto base = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
    mesh.surface.insert(mesh.surface.end(), other.surface.begin(), other.surface.end());
    for (const glm::uvec3& t : other.triangles) {
        mesh.triangles.push_back(t + base);
    }
    mesh.material.insert(mesh.material.end(), other.material.begin(), other.material.end());
}

PartMesh moved(PartMesh mesh, const glm::vec3& by) {
    for (glm::vec3& p : mesh.positions) {
        p += by;
    }
    return mesh;
}

PartMesh turned(PartMesh mesh, const glm::mat3& rotation) {
    for (glm::vec3& p : mesh.positions) {
        p = rotation * p;
    }
    for (glm::vec3& n : mesh.normals) {
        n = rotation * n;
    }
    return mesh;
}

PartMesh mirroredLeftRight(PartMesh mesh) {
    for (glm::vec3& p : mesh.positions) {
        p.y = -p.y;
    }
    for (glm::vec3& n : mesh.normals) {
        n.y = -n.y;
    }
    for (glm::uvec3& t : mesh.triangles) {
        std::swap(t.y, t.z);
    }
    return mesh;
}

PartMesh turnedAround(PartMesh mesh) {
    return turned(std::move(mesh),
                  glm::mat3(-1.0F, 0.0F, 0.0F, 0.0F, -1.0F, 0.0F, 0.0F, 0.0F, 1.0F));
}

void faceOutwards(PartMesh& mesh) {
    double volume = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        volume += double(
            glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])));
    }
    if (volume >= 0.0) {
        return;
    }
    for (glm::uvec3& t : mesh.triangles) {
        std::swap(t.y, t.z);
    }
    for (glm::vec3& n : mesh.normals) {
        n = -n;
    }
}

}  // namespace reflet
