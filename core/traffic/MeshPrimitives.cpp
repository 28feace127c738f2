// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/MeshPrimitives.h"

#include "core/math/Geometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

constexpr float kPiF = float(kPi);
constexpr float kSharp = 0.6F;  // radians: edges of solids stay sharp beyond this

/// Two unit vectors that make a right-handed frame with the unit `axis` as third.
void frameAround(const glm::vec3& axis, glm::vec3& u, glm::vec3& v) {
    const glm::vec3 other = std::abs(axis.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    u = glm::normalize(glm::cross(other, axis));
    v = glm::cross(axis, u);
}

/// Coordinates across a face of a rounded box: dense over the rounded ends.
std::vector<float> faceSteps(float half, float radius) {
    const int arcs = radius > 0.06F ? 3 : radius > 0.04F ? 2 : 1;
    std::vector<float> steps;
    if (radius > 0.0F) {
        for (int i = 0; i < arcs; ++i) {
            const float angle = (1.0F - float(i) / float(arcs)) * kPiF / 4.0F;
            steps.push_back(-(half - radius) - radius * std::tan(angle));
        }
    }
    const float flat = half - radius;
    if (flat > 1e-5F) {
        steps.push_back(-flat);
    }
    const std::size_t count = steps.size();
    if (flat <= 1e-5F) {
        steps.push_back(0.0F);
    }
    for (std::size_t i = count; i-- > 0;) {
        steps.push_back(-steps[i]);
    }
    return steps;
}

}  // namespace

PartMesh roundedBox(const glm::vec3& center, const glm::vec3& size, float radius,
                    std::uint16_t material) {
    const glm::vec3 half = 0.5F * size;
    const float r = std::min({radius, half.x, half.y, half.z});
    PartMesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3;
        const int b = (axis + 2) % 3;
        const std::vector<float> us = faceSteps(half[a], r);
        const std::vector<float> vs = faceSteps(half[b], r);
        for (const float sign : {-1.0F, 1.0F}) {
            append(mesh,
                   gridSurface(
                       int(us.size()), int(vs.size()), false, material, kPiF, [&](int i, int j) {
                           glm::vec3 q(0.0F);
                           q[axis] = sign * half[axis];
                           q[a] = us[std::size_t(i)];
                           q[b] = vs[std::size_t(j)] * -sign;
                           const glm::vec3 core = glm::clamp(q, -half + r, half - r);
                           const glm::vec3 d = q - core;
                           const float length = glm::length(d);
                           return GridPoint{
                               center + (r > 0.0F && length > 0.0F ? core + d * (r / length) : q),
                               {}};
                       }));
        }
    }
    smoothNormals(mesh, r > 0.0F ? 0.8F : 0.3F);
    return mesh;
}

PartMesh lathe(const std::vector<glm::vec2>& profile, const glm::vec3& center,
               const glm::vec3& axis, int segments, float crease, std::uint16_t material) {
    glm::vec3 u;
    glm::vec3 v;
    const glm::vec3 w = glm::normalize(axis);
    frameAround(w, u, v);
    PartMesh mesh =
        gridSurface(int(profile.size()), segments, true, material, crease, [&](int i, int j) {
            const float angle = 2.0F * kPiF * float(j) / float(segments);
            const glm::vec2 p = profile[std::size_t(i)];
            return GridPoint{center + w * p.y + (u * std::cos(angle) + v * std::sin(angle)) * p.x,
                             p};
        });
    faceOutwards(mesh);
    return mesh;
}

PartMesh cylinder(const glm::vec3& from, const glm::vec3& to, float radius, int segments,
                  std::uint16_t material) {
    const float length = glm::distance(from, to);
    return lathe({{0, 0}, {radius, 0}, {radius, length}, {0, length}}, from, to - from, segments,
                 kSharp, material);
}

PartMesh ellipsoid(const glm::vec3& center, const glm::vec3& halfAxes, int segments,
                   std::uint16_t material) {
    const int rows = segments / 2 + 1;
    PartMesh mesh = gridSurface(rows, segments, true, material, kPiF, [&](int i, int j) {
        const float polar = kPiF * float(i) / float(rows - 1);
        const float around = 2.0F * kPiF * float(j) / float(segments);
        const float ring = i == 0 || i == rows - 1 ? 0.0F : std::sin(polar);
        const glm::vec3 d(ring * std::cos(around), ring * std::sin(around), std::cos(polar));
        return GridPoint{center + halfAxes * d, {}};
    });
    faceOutwards(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        // The gradient of (x/a)² + (y/b)² + (z/c)².
        mesh.normals[i] = glm::normalize((mesh.positions[i] - center) / (halfAxes * halfAxes));
    }
    return mesh;
}

PartMesh tube(const std::vector<glm::vec3>& path, float radius, int segments,
              std::uint16_t material) {
    const int n = int(path.size());
    const glm::vec3 first = glm::normalize(path[1] - path[0]);
    glm::vec3 u;
    glm::vec3 v;
    frameAround(first, u, v);
    std::vector<std::vector<glm::vec3>> rings;
    for (int i = 0; i < n; ++i) {
        const glm::vec3 in = glm::normalize(path[std::size_t(std::max(i, 1))] -
                                            path[std::size_t(std::max(i, 1) - 1)]);
        const glm::vec3 out = glm::normalize(path[std::size_t(std::min(i + 1, n - 1))] -
                                             path[std::size_t(std::min(i + 1, n - 1) - 1)]);
        const glm::vec3 along = glm::normalize(in + out);
        u = glm::normalize(u - along * glm::dot(u, along));
        v = glm::cross(along, u);
        std::vector<glm::vec3> ring;
        for (int j = 0; j < segments; ++j) {
            const float angle = 2.0F * kPiF * float(j) / float(segments);
            ring.push_back(path[std::size_t(i)] +
                           radius * (u * std::cos(angle) + v * std::sin(angle)));
        }
        rings.push_back(std::move(ring));
    }
    PartMesh mesh = gridSurface(n + 2, segments, true, material, kSharp, [&](int i, int j) {
        const glm::vec3 p = i == 0       ? path.front()
                            : i == n + 1 ? path.back()
                                         : rings[std::size_t(i - 1)][std::size_t(j)];
        return GridPoint{p, {}};
    });
    faceOutwards(mesh);
    return mesh;
}

PartMesh extrudedAcross(const std::vector<glm::vec2>& polygon, float y0, float y1,
                        std::uint16_t material) {
    glm::vec2 mean(0.0F);
    for (const glm::vec2& p : polygon) {
        mean += p / float(polygon.size());
    }
    PartMesh mesh = gridSurface(4, int(polygon.size()), true, material, kSharp, [&](int i, int j) {
        const glm::vec2 p = i == 0 || i == 3 ? mean : polygon[std::size_t(j)];
        return GridPoint{glm::vec3(p.x, i < 2 ? y0 : y1, p.y), {}};
    });
    faceOutwards(mesh);
    return mesh;
}

}  // namespace reflet
