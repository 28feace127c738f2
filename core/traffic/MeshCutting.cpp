// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/MeshCutting.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {
namespace {

constexpr float kOnBorder = 1e-5F;      // metres: a vertex this close counts as on the border
constexpr float kChordError = 0.0008F;  // metres
constexpr float kShortest = 0.004F;     // metres: shorter edges are not refined
constexpr int kRefinements = 4;
constexpr std::uint32_t kNone = 0xffffffffU;

SurfacePoint pointAt(const PartMesh& mesh, std::uint32_t v) {
    return {mesh.positions[v], mesh.normals[v], mesh.surface[v]};
}

SurfacePoint mixed(const SurfacePoint& a, const SurfacePoint& b, float t) {
    return {glm::mix(a.position, b.position, t), glm::normalize(glm::mix(a.normal, b.normal, t)),
            glm::mix(a.surface, b.surface, t)};
}

std::uint32_t addPoint(PartMesh& mesh, const SurfacePoint& p) {
    mesh.positions.push_back(p.position);
    mesh.normals.push_back(p.normal);
    mesh.surface.push_back(p.surface);
    return std::uint32_t(mesh.positions.size() - 1);
}

SurfacePoint centroid(const PartMesh& mesh, const glm::uvec3& t) {
    const glm::vec3 n = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    return {(mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F,
            glm::length(n) > 1e-6F ? glm::normalize(n) : mesh.normals[t.x],
            (mesh.surface[t.x] + mesh.surface[t.y] + mesh.surface[t.z]) / 3.0F};
}

/// Appends the pieces of a triangle whose edges (xy, yz, zx) have points where not kNone.
void splitAtPoints(const glm::uvec3& t, const std::array<std::uint32_t, 3>& m,
                   std::vector<glm::uvec3>& out) {
    const int count = int(m[0] != kNone) + int(m[1] != kNone) + int(m[2] != kNone);
    if (count == 3) {
        out.emplace_back(t.x, m[0], m[2]);
        out.emplace_back(m[0], t.y, m[1]);
        out.emplace_back(m[2], m[1], t.z);
        out.emplace_back(m[0], m[1], m[2]);
        return;
    }
    // Turn the triangle so that edge 0 is split (count 1), or edge 2 is not (count 2).
    std::size_t k = 0;
    while (count == 1 ? m[k] == kNone : m[(k + 2) % 3] != kNone) {
        ++k;
    }
    const std::uint32_t a = t[int(k)];
    const std::uint32_t b = t[int((k + 1) % 3)];
    const std::uint32_t c = t[int((k + 2) % 3)];
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

/// A value for each undirected edge, kNone where none was given. Open addressing: cutting asks for
/// edges more often than for anything else.
class EdgeTable {
public:
    explicit EdgeTable(std::size_t expected) {
        std::size_t size = 64;
        while (size < 2 * expected)
            size *= 2;
        m_slots.resize(size);
    }
    /// The value of an edge; isNew when it was not asked for before.
    std::uint32_t& at(std::uint32_t a, std::uint32_t b, bool& isNew) {
        if (2 * m_count >= m_slots.size())
            grow();
        Slot& slot = slotOf((std::uint64_t(std::min(a, b)) << 32U) | std::max(a, b));
        isNew = slot.key == kEmpty;
        if (isNew) {
            slot.key = (std::uint64_t(std::min(a, b)) << 32U) | std::max(a, b);
            ++m_count;
        }
        return slot.value;
    }
    [[nodiscard]] std::uint32_t find(std::uint32_t a, std::uint32_t b) {
        return slotOf((std::uint64_t(std::min(a, b)) << 32U) | std::max(a, b)).value;
    }
    [[nodiscard]] bool empty() const { return m_count == 0; }

private:
    static constexpr std::uint64_t kEmpty = ~std::uint64_t(0);
    struct Slot {
        std::uint64_t key = kEmpty;
        std::uint32_t value = kNone;
    };
    Slot& slotOf(std::uint64_t key) {
        const std::size_t mask = m_slots.size() - 1;
        std::size_t i = std::size_t((key * 0x9e3779b97f4a7c15ULL) >> 32U) & mask;
        while (m_slots[i].key != kEmpty && m_slots[i].key != key)
            i = (i + 1) & mask;
        return m_slots[i];
    }
    void grow() {
        std::vector<Slot> old(m_slots.size() * 2);
        old.swap(m_slots);
        for (const Slot& slot : old) {
            if (slot.key != kEmpty)
                slotOf(slot.key) = slot;
        }
    }
    std::vector<Slot> m_slots;
    std::size_t m_count = 0;
};

/// A mesh with the value of a region at each vertex. Regions are costly and triangles far from a
/// border stay as they are, so each vertex is asked once and each cut visits only what is near.
class Cutter {
public:
    Cutter(PartMesh& mesh, const Region& region) : m_mesh(mesh), m_region(region) {
        m_values.reserve(mesh.positions.size());
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            m_values.push_back(region(pointAt(mesh, std::uint32_t(v))));
        }
    }

    /// Splits triangles along the line where the region's value is `level`.
    void cut(float level) {
        m_level = level;
        for (float& value : m_values) {
            value = std::abs(value - level) < kOnBorder ? level : value;
        }
        findNear();
        for (int i = 0; i < kRefinements && refine(); ++i) {
        }
        splitWhere([this](std::uint32_t a, std::uint32_t b) { return above(a) * above(b) < 0.0F; },
                   [this](std::uint32_t a, std::uint32_t b) {
                       const SurfacePoint p = crossing(a, b);
                       m_values.push_back(m_level);
                       return addPoint(m_mesh, p);
                   });
    }

    [[nodiscard]] float value(std::size_t vertex) const { return m_values[vertex]; }

    /// The region's mean over a triangle that no longer crosses the levels that were cut; asked
    /// again where its corners do not tell on which side it lies.
    [[nodiscard]] float middle(std::size_t triangle, float level) const {
        const glm::uvec3& t = m_mesh.triangles[triangle];
        const float mean = (m_values[t.x] + m_values[t.y] + m_values[t.z]) / 3.0F;
        return std::abs(mean - level) < kOnBorder ? m_region(centroid(m_mesh, t)) : mean;
    }

private:
    [[nodiscard]] float above(std::uint32_t v) const { return m_values[v] - m_level; }
    [[nodiscard]] float length(std::uint32_t a, std::uint32_t b) const {
        return glm::distance(m_mesh.positions[a], m_mesh.positions[b]);
    }
    [[nodiscard]] bool crosses(const glm::uvec3& t) const {
        const float g[3] = {above(t.x), above(t.y), above(t.z)};
        return std::min({g[0], g[1], g[2]}) < 0.0F && std::max({g[0], g[1], g[2]}) > 0.0F;
    }
    /// Both ends on one side, but near enough that the border may cross the edge twice.
    [[nodiscard]] bool mayBulge(std::uint32_t a, std::uint32_t b) const {
        const float fa = above(a);
        const float fb = above(b);
        if (fa * fb <= 0.0F)
            return false;
        const glm::vec3 edge = m_mesh.positions[a] - m_mesh.positions[b];
        const float sum = fa + fb;
        const float square = glm::dot(edge, edge);
        return sum * sum < square && square > kShortest * kShortest;
    }

    /// The triangles that the border may meet: a region is a distance, so it cannot be nearer than
    /// a corner says.
    void findNear() {
        m_near.clear();
        for (std::size_t i = 0; i < m_mesh.triangles.size(); ++i) {
            const glm::uvec3& t = m_mesh.triangles[i];
            if (crosses(t) || mayBulge(t.x, t.y) || mayBulge(t.y, t.z) || mayBulge(t.z, t.x)) {
                m_near.push_back(std::uint32_t(i));
            }
        }
    }

    /// Where the border crosses the edge: false position, which suits regions that are not linear.
    [[nodiscard]] SurfacePoint crossing(std::uint32_t from, std::uint32_t to) const {
        const std::uint32_t a = std::min(from, to);
        const SurfacePoint pa = pointAt(m_mesh, a);
        const SurfacePoint pb = pointAt(m_mesh, std::max(from, to));
        float fa = above(a);
        float fb = above(std::max(from, to));
        float low = 0.0F;
        float high = 1.0F;
        SurfacePoint p;
        for (int i = 0; i < 12; ++i) {
            const float t = std::clamp(low + (high - low) * fa / (fa - fb),
                                       low + 0.05F * (high - low), high - 0.05F * (high - low));
            p = mixed(pa, pb, t);
            const float f = m_region(p) - m_level;
            if (std::abs(f) < 1e-6F)
                break;
            if ((f < 0.0F) == (fa < 0.0F)) {
                low = t;
                fa = f;
            } else {
                high = t;
                fb = f;
            }
        }
        return p;
    }

    /// Whether it does; asked for edges that may.
    [[nodiscard]] bool bulges(std::uint32_t a, std::uint32_t b) const {
        const float fa = above(a);
        const float fb = above(b);
        const float edge = length(a, b);
        const float f = m_region(mixed(pointAt(m_mesh, a), pointAt(m_mesh, b), 0.5F)) - m_level;
        if (f * fa < 0.0F)
            return std::abs(f) > kChordError;
        const bool open = std::min(std::abs(fa), std::abs(fb)) + std::abs(f) < 0.5F * edge;
        return open && std::abs(f - 0.5F * (fa + fb)) > 4.0F * kChordError;
    }

    /// Whether the border in a triangle strays from a straight line.
    [[nodiscard]] bool bends(const glm::uvec3& t) const {
        SurfacePoint ends[2];
        int count = 0;
        for (int k = 0; k < 3 && count < 2; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            if (above(a) == 0.0F) {
                ends[count++] = pointAt(m_mesh, a);
            } else if (above(a) * above(b) < 0.0F) {
                ends[count++] = crossing(a, b);
            }
        }
        if (count < 2)
            return false;
        return std::abs(m_region(mixed(ends[0], ends[1], 0.5F)) - m_level) > kChordError;
    }

    /// One pass of refinement; false when nothing was split.
    bool refine() {
        EdgeTable marks(m_near.size());
        bool any = false;
        for (const std::uint32_t i : m_near) {
            const glm::uvec3 t = m_mesh.triangles[i];
            const bool bent = crosses(t) && bends(t);
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k];
                const std::uint32_t b = t[(k + 1) % 3];
                bool isNew = false;
                if (bent && above(a) * above(b) < 0.0F && length(a, b) >= kShortest) {
                    marks.at(a, b, isNew) = 1;
                    any = true;
                } else if (mayBulge(a, b)) {
                    std::uint32_t& mark = marks.at(a, b, isNew);
                    if (isNew && bulges(a, b))
                        mark = 1;
                    any = any || mark == 1;
                }
            }
        }
        if (any) {
            splitWhere([&](std::uint32_t a, std::uint32_t b) { return marks.find(a, b) == 1; },
                       [&](std::uint32_t a, std::uint32_t b) {
                           const SurfacePoint p = mixed(pointAt(m_mesh, std::min(a, b)),
                                                        pointAt(m_mesh, std::max(a, b)), 0.5F);
                           const float f = m_region(p);
                           m_values.push_back(std::abs(f - m_level) < kOnBorder ? m_level : f);
                           return addPoint(m_mesh, p);
                       });
        }
        return any;
    }

    /// Splits the near triangles on those edges for which `wanted` holds, at the points that
    /// `pointOn` makes, asked once for each edge.
    template <class Wanted, class PointOn>
    void splitWhere(Wanted&& wanted, PointOn&& pointOn) {
        EdgeTable points(m_near.size() / 2);
        std::vector<std::uint32_t> added;
        std::vector<glm::uvec3> pieces;
        for (const std::uint32_t i : m_near) {
            const glm::uvec3 t = m_mesh.triangles[i];
            std::array<std::uint32_t, 3> on{kNone, kNone, kNone};
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k];
                const std::uint32_t b = t[(k + 1) % 3];
                if (!wanted(a, b))
                    continue;
                bool isNew = false;
                std::uint32_t& point = points.at(a, b, isNew);
                if (isNew)
                    point = pointOn(a, b);
                on[std::size_t(k)] = point;
            }
            if (on[0] == kNone && on[1] == kNone && on[2] == kNone)
                continue;
            pieces.clear();
            splitAtPoints(t, on, pieces);
            m_mesh.triangles[i] = pieces.front();
            for (std::size_t piece = 1; piece < pieces.size(); ++piece) {
                added.push_back(std::uint32_t(m_mesh.triangles.size()));
                m_mesh.triangles.push_back(pieces[piece]);
                m_mesh.material.push_back(m_mesh.material[i]);
            }
        }
        m_near.insert(m_near.end(), added.begin(), added.end());
    }

    PartMesh& m_mesh;
    const Region& m_region;
    std::vector<float> m_values;        // of the region, per vertex
    std::vector<std::uint32_t> m_near;  // triangles
    float m_level = 0.0F;
};

/// The triangles for which `wanted` holds, with the vertices that they use.
template <class Wanted>
PartMesh selected(const PartMesh& mesh, Wanted&& wanted) {
    PartMesh kept;
    std::vector<std::uint32_t> index(mesh.positions.size(), kNone);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!wanted(i)) {
            continue;
        }
        glm::uvec3 t = mesh.triangles[i];
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& v = index[t[k]];
            if (v == kNone) {
                v = addPoint(kept, pointAt(mesh, t[k]));
            }
            t[k] = v;
        }
        kept.triangles.push_back(t);
        kept.material.push_back(mesh.material[i]);
    }
    return kept;
}

}  // namespace

void cutAlong(PartMesh& mesh, const Region& region) {
    Cutter(mesh, region).cut(0.0F);
}

void paint(PartMesh& mesh, const Region& region, std::uint16_t material) {
    Cutter cutter(mesh, region);
    cutter.cut(0.0F);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (cutter.middle(i, 0.0F) < 0.0F) {
            mesh.material[i] = material;
        }
    }
}

void outline(PartMesh& mesh, const Region& region, float width, std::uint16_t material) {
    const float half = 0.5F * width;
    Cutter cutter(mesh, region);
    cutter.cut(half);
    cutter.cut(-half);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (cutter.middle(i, half) < half && cutter.middle(i, -half) > -half) {
            mesh.material[i] = material;
        }
    }
}

void inset(PartMesh& mesh, const Region& region, float width, float depth, std::uint16_t rim,
           std::uint16_t inner) {
    Cutter cutter(mesh, region);
    cutter.cut(0.0F);
    cutter.cut(-width);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (cutter.middle(i, 0.0F) < 0.0F) {
            mesh.material[i] = cutter.middle(i, -width) < -width ? inner : rim;
        }
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const float share = std::clamp(-cutter.value(v) / width, 0.0F, 1.0F);
        mesh.positions[v] -= mesh.normals[v] * (depth * share);
    }
}

void removeInside(PartMesh& mesh, const Region& region) {
    Cutter cutter(mesh, region);
    cutter.cut(0.0F);
    mesh = selected(mesh, [&](std::size_t i) { return cutter.middle(i, 0.0F) >= 0.0F; });
}

SplitMesh splitAcross(PartMesh mesh) {
    const Region ahead = [](const SurfacePoint& p) { return p.position.x; };
    Cutter cutter(mesh, ahead);
    cutter.cut(0.0F);
    return {selected(mesh, [&](std::size_t i) { return cutter.middle(i, 0.0F) < 0.0F; }),
            selected(mesh, [&](std::size_t i) { return cutter.middle(i, 0.0F) >= 0.0F; })};
}

}  // namespace reflet
