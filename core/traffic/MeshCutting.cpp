// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/MeshCutting.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace reflet {
namespace {

constexpr float kOnBorder = 1e-5F;      // metres: a vertex this close counts as on the border
constexpr float kChordError = 0.0008F;  // metres
constexpr int kRefinements = 4;

SurfacePoint pointAt(const PartMesh& mesh, std::uint32_t v) {
    return {mesh.positions[v], mesh.normals[v], mesh.surface[v]};
}

SurfacePoint between(const PartMesh& mesh, std::uint32_t a, std::uint32_t b, float t) {
    const glm::vec3 n = glm::mix(mesh.normals[a], mesh.normals[b], t);
    return {glm::mix(mesh.positions[a], mesh.positions[b], t), glm::normalize(n),
            glm::mix(mesh.surface[a], mesh.surface[b], t)};
}

std::uint32_t addPoint(PartMesh& mesh, const SurfacePoint& p) {
    mesh.positions.push_back(p.position);
    mesh.normals.push_back(p.normal);
    mesh.surface.push_back(p.surface);
    return std::uint32_t(mesh.positions.size() - 1);
}

/// New vertices on edges, one per undirected edge.
class EdgePoints {
public:
    static constexpr std::uint32_t kNotSplit = 0xffffffffU;

    std::uint32_t& at(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = (std::uint64_t(std::min(a, b)) << 32U) | std::max(a, b);
        return m_points.try_emplace(key, kUnknown).first->second;
    }
    static constexpr std::uint32_t kUnknown = 0xfffffffeU;

private:
    std::unordered_map<std::uint64_t, std::uint32_t> m_points;
};

float evaluate(const Region& region, const SurfacePoint& p) {
    const float f = region(p);
    return std::abs(f) < kOnBorder ? 0.0F : f;
}

std::vector<float> evaluate(const PartMesh& mesh, const Region& region) {
    std::vector<float> f(mesh.positions.size());
    for (std::size_t i = 0; i < f.size(); ++i) {
        f[i] = evaluate(region, pointAt(mesh, std::uint32_t(i)));
    }
    return f;
}

/// Replaces triangles by those that `split` gives for them, material kept.
template <class Split>
void replaceTriangles(PartMesh& mesh, Split&& split) {
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint16_t> material;
    std::vector<glm::uvec3> pieces;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        pieces.clear();
        split(mesh.triangles[i], pieces);
        triangles.insert(triangles.end(), pieces.begin(), pieces.end());
        material.insert(material.end(), pieces.size(), mesh.material[i]);
    }
    mesh.triangles = std::move(triangles);
    mesh.material = std::move(material);
}

/// The pieces of a triangle whose edges (xy, yz, zx) have mid points where not kNotSplit.
void splitAtMiddles(const glm::uvec3& t, const std::uint32_t (&m)[3],
                    std::vector<glm::uvec3>& out) {
    const auto none = EdgePoints::kNotSplit;
    const int count = int(m[0] != none) + int(m[1] != none) + int(m[2] != none);
    if (count == 0) {
        out.push_back(t);
        return;
    }
    if (count == 3) {
        out.emplace_back(t.x, m[0], m[2]);
        out.emplace_back(m[0], t.y, m[1]);
        out.emplace_back(m[2], m[1], t.z);
        out.emplace_back(m[0], m[1], m[2]);
        return;
    }
    // Turn the triangle so that edge 0 is split (count 1), or edge 2 is not (count 2).
    int k = 0;
    while (count == 1 ? m[k] == none : m[(k + 2) % 3] != none) {
        ++k;
    }
    const std::uint32_t a = t[k];
    const std::uint32_t b = t[(k + 1) % 3];
    const std::uint32_t c = t[(k + 2) % 3];
    if (count == 1) {
        out.emplace_back(a, m[k], c);
        out.emplace_back(m[k], b, c);
        return;
    }
    const std::uint32_t ab = m[k];
    const std::uint32_t bc = m[(k + 1) % 3];
    out.emplace_back(ab, b, bc);
    out.emplace_back(a, ab, bc);
    out.emplace_back(a, bc, c);
}

/// One pass of refinement; false when nothing was split.
bool refineOnce(PartMesh& mesh, const Region& region) {
    std::vector<float> f = evaluate(mesh, region);
    EdgePoints middles;
    bool any = false;
    const auto middleOf = [&](std::uint32_t a, std::uint32_t b) {
        const float length = glm::distance(mesh.positions[a], mesh.positions[b]);
        if (std::min(std::abs(f[a]), std::abs(f[b])) > length || length < 0.004F) {
            return EdgePoints::kNotSplit;
        }
        std::uint32_t& known = middles.at(a, b);
        if (known != EdgePoints::kUnknown) {
            return known;
        }
        known = EdgePoints::kNotSplit;
        const SurfacePoint p = between(mesh, std::min(a, b), std::max(a, b), 0.5F);
        const float middle = region(p);
        if (std::abs(middle - 0.5F * (f[a] + f[b])) > kChordError) {
            any = true;
            known = addPoint(mesh, p);
        }
        return known;
    };
    replaceTriangles(mesh, [&](const glm::uvec3& t, std::vector<glm::uvec3>& out) {
        const std::uint32_t m[3] = {middleOf(t.x, t.y), middleOf(t.y, t.z), middleOf(t.z, t.x)};
        splitAtMiddles(t, m, out);
    });
    return any;
}

/// Where the border crosses the edge: false position, which suits regions that are not linear.
float crossing(const PartMesh& mesh, const Region& region, std::uint32_t a, std::uint32_t b,
               float fa, float fb) {
    float low = 0.0F;
    float high = 1.0F;
    float t = 0.5F;
    for (int i = 0; i < 12; ++i) {
        t = std::clamp(low + (high - low) * fa / (fa - fb), low + 0.05F * (high - low),
                       high - 0.05F * (high - low));
        const float f = region(between(mesh, a, b, t));
        if (std::abs(f) < 1e-6F) {
            break;
        }
        if ((f < 0.0F) == (fa < 0.0F)) {
            low = t;
            fa = f;
        } else {
            high = t;
            fb = f;
        }
    }
    return t;
}

SurfacePoint centroid(const PartMesh& mesh, const glm::uvec3& t) {
    const glm::vec3 n = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    return {(mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F,
            glm::length(n) > 1e-6F ? glm::normalize(n) : mesh.normals[t.x],
            (mesh.surface[t.x] + mesh.surface[t.y] + mesh.surface[t.z]) / 3.0F};
}

/// The triangles for which `wanted` holds, with the vertices that they use.
template <class Wanted>
PartMesh selected(const PartMesh& mesh, Wanted&& wanted) {
    PartMesh kept;
    std::vector<std::uint32_t> index(mesh.positions.size(), EdgePoints::kNotSplit);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!wanted(centroid(mesh, mesh.triangles[i]))) {
            continue;
        }
        glm::uvec3 t = mesh.triangles[i];
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& v = index[t[k]];
            if (v == EdgePoints::kNotSplit) {
                v = addPoint(kept, pointAt(mesh, t[k]));
            }
            t[k] = v;
        }
        kept.triangles.push_back(t);
        kept.material.push_back(mesh.material[i]);
    }
    return kept;
}

Region grown(const Region& region, float by) {
    return [&region, by](const SurfacePoint& p) { return region(p) - by; };
}

}  // namespace

void cutAlong(PartMesh& mesh, const Region& region) {
    for (int i = 0; i < kRefinements && refineOnce(mesh, region); ++i) {
    }
    const std::vector<float> f = evaluate(mesh, region);
    EdgePoints cuts;
    const auto cutOf = [&](std::uint32_t a, std::uint32_t b) {
        if (f[a] * f[b] >= 0.0F) {
            return EdgePoints::kNotSplit;
        }
        std::uint32_t& known = cuts.at(a, b);
        if (known == EdgePoints::kUnknown) {
            const std::uint32_t lo = std::min(a, b);
            const std::uint32_t hi = std::max(a, b);
            const float t = crossing(mesh, region, lo, hi, f[lo], f[hi]);
            known = addPoint(mesh, between(mesh, lo, hi, t));
        }
        return known;
    };
    replaceTriangles(mesh, [&](const glm::uvec3& t, std::vector<glm::uvec3>& out) {
        const std::uint32_t m[3] = {cutOf(t.x, t.y), cutOf(t.y, t.z), cutOf(t.z, t.x)};
        splitAtMiddles(t, m, out);
    });
}

void paint(PartMesh& mesh, const Region& region, std::uint16_t material) {
    cutAlong(mesh, region);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (region(centroid(mesh, mesh.triangles[i])) < 0.0F) {
            mesh.material[i] = material;
        }
    }
}

void outline(PartMesh& mesh, const Region& region, float width, std::uint16_t material) {
    cutAlong(mesh, grown(region, 0.5F * width));
    cutAlong(mesh, grown(region, -0.5F * width));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (std::abs(region(centroid(mesh, mesh.triangles[i]))) < 0.5F * width) {
            mesh.material[i] = material;
        }
    }
}

void inset(PartMesh& mesh, const Region& region, float width, float depth, std::uint16_t rim,
           std::uint16_t inner) {
    cutAlong(mesh, region);
    cutAlong(mesh, grown(region, -width));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const float f = region(centroid(mesh, mesh.triangles[i]));
        if (f < 0.0F) {
            mesh.material[i] = f < -width ? inner : rim;
        }
    }
    const std::vector<float> f = evaluate(mesh, region);
    for (std::size_t i = 0; i < f.size(); ++i) {
        mesh.positions[i] -= mesh.normals[i] * (depth * std::clamp(-f[i] / width, 0.0F, 1.0F));
    }
}

void removeInside(PartMesh& mesh, const Region& region) {
    cutAlong(mesh, region);
    mesh = selected(mesh, [&](const SurfacePoint& p) { return region(p) >= 0.0F; });
}

SplitMesh splitAcross(PartMesh mesh) {
    cutAlong(mesh, [](const SurfacePoint& p) { return p.position.x; });
    return {selected(mesh, [](const SurfacePoint& p) { return p.position.x < 0.0F; }),
            selected(mesh, [](const SurfacePoint& p) { return p.position.x >= 0.0F; })};
}

}  // namespace reflet
