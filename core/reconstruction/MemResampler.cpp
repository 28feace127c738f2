// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/MemResampler.h"

#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemMesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

/// From so many texels on it pays to find the one face of a REM that serves the whole leaf.
constexpr int kManyTexels = 8;

}  // namespace

/// What is interpolated over a leaf, and how.
struct MemResampler::Leaf {
    TexelRange columns;
    TexelRange rows;
    LeafScalar inverseDepth;
    LeafScalar weightB;
    std::optional<LeafLookup> a;  ///< empty: weight 0 at all corners
    std::optional<LeafLookup> b;
    bool uncovered = false;
};

MemResampler::MemResampler(const ReconstructionInput& input, const RemChoice& choice,
                           const glm::dvec3& position, Interpolation interpolation,
                           LocalEnvironmentMap& map)
    : m_interpolation(interpolation), m_sceneDiameter(input.sceneDiameter), m_map(map) {
    const auto source = [&](std::size_t index) {
        const ReferenceEnvironmentMap& rem = input.rems[index];
        return Source{&rem, CubeSampler(rem.radiance), position - rem.center};
    };
    if (choice.a)
        m_a = source(*choice.a);
    if (choice.b)
        m_b = source(*choice.b);
}

void MemResampler::writeLeaf(int faceIndex, const MemFace& face, const MemQuad& quad) const {
    const int n = m_map.radiance.resolution();
    if (quad.vertex[0] == quad.vertex[3]) {
        const int column = texelsWithin(n, quad.s0, quad.s1).first;
        const int row = texelsWithin(n, quad.t0, quad.t1).first;
        writeTexelLeaf(faceIndex, face.vertices[quad.vertex[0]], column, row);
        return;
    }
    const Leaf leaf = prepare(face, quad);
    TexelRun run;
    const double perS = 1.0 / (quad.s1 - quad.s0);
    const double perT = 1.0 / (quad.t1 - quad.t0);
    for (int first = leaf.columns.first; first < leaf.columns.last; first += TexelRun::kMost) {
        run.count = std::min(TexelRun::kMost, leaf.columns.last - first);
        for (int i = 0; i < run.count; ++i) {
            run.u[std::size_t(i)] = float((texelCoordinate(n, first + i) - quad.s0) * perS);
        }
        for (int row = leaf.rows.first; row < leaf.rows.last; ++row) {
            run.v = float((texelCoordinate(n, row) - quad.t0) * perT);
            writeRun(faceIndex, row, first, leaf, run);
        }
    }
}

MemResampler::Leaf MemResampler::prepare(const MemFace& face, const MemQuad& quad) const {
    const int n = m_map.radiance.resolution();
    Leaf leaf;
    leaf.columns = texelsWithin(n, quad.s0, quad.s1);
    leaf.rows = texelsWithin(n, quad.t0, quad.t1);
    bool usesA = false;
    bool usesB = false;
    for (std::size_t k = 0; k < 4; ++k) {
        const MemVertex& vertex = face.vertices[quad.vertex[k]];
        leaf.inverseDepth.corner[k] = float(vertex.inverseDepth);
        leaf.weightB.corner[k] = float(vertex.weightB);
        usesA = usesA || vertex.weightA > 0.0;
        usesB = usesB || vertex.weightB > 0.0;
        leaf.uncovered = leaf.uncovered || vertex.uncovered;
    }
    const int texels =
        (leaf.columns.last - leaf.columns.first) * (leaf.rows.last - leaf.rows.first);
    if (m_a && usesA)
        leaf.a.emplace(lookup(*m_a, face, quad, texels >= kManyTexels));
    if (m_b && usesB)
        leaf.b.emplace(lookup(*m_b, face, quad, texels >= kManyTexels));
    return leaf;
}

/// I = P + z d′, so that C→I = z (d′ + (P − C)/z), and the factor z does not matter to a lookup by
/// direction. On a plane 1/z is affine in (s, t), and with it the bracket: interpolated bilinearly
/// between the corners it is exact. The paper interpolates C→I itself, which is not.
LeafLookup MemResampler::lookup(const Source& source, const MemFace& face, const MemQuad& quad,
                                bool manyTexels) const {
    std::array<glm::vec3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
        const MemVertex& vertex = face.vertices[quad.vertex[k]];
        if (m_interpolation == Interpolation::Exact) {
            corners[k] = glm::vec3(vertex.direction + vertex.inverseDepth * source.offset);
        } else if (vertex.sky) {
            corners[k] = glm::vec3(m_sceneDiameter * glm::normalize(vertex.direction));
        } else {
            corners[k] = glm::vec3(vertex.point - source.rem->center);
        }
    }
    return {source.sampler, corners, manyTexels};
}

void MemResampler::writeRun(int faceIndex, int row, int column, const Leaf& leaf,
                            const TexelRun& run) const {
    std::array<Float4, TexelRun::kMost> radiance, other;
    const auto count = std::size_t(run.count);
    if (leaf.a) {
        leaf.a->read(run, radiance);
    } else if (leaf.b) {
        leaf.b->read(run, radiance);
    } else {
        radiance.fill(Float4{});
    }
    if (leaf.a && leaf.b) {
        leaf.b->read(run, other);
        const LeafScalar::Line weight = leaf.weightB.along(run.v);
        for (std::size_t i = 0; i < count; ++i)
            radiance[i] += weight.at(run.u[i]) * (other[i] - radiance[i]);
    }
    const int n = m_map.radiance.resolution();
    glm::vec3* texels = &m_map.radiance.at(faceIndex, column, row);
    float* distances = &m_map.distance.at(faceIndex, column, row);
    const LeafScalar::Line inverseDepth = leaf.inverseDepth.along(run.v);
    const auto t = float(texelCoordinate(n, row));
    for (std::size_t i = 0; i < count; ++i) {
        texels[i] = toVec3(radiance[i]);
        const auto s = float(texelCoordinate(n, column + int(i)));
        const float w = inverseDepth.at(run.u[i]);
        distances[i] = w > 0.0f ? std::sqrt(1.0f + s * s + t * t) / w : kInfinity;
    }
    std::fill_n(&m_map.uncovered.at(faceIndex, column, row), count, leaf.uncovered ? 1 : 0);
}

void MemResampler::writeTexelLeaf(int faceIndex, const MemVertex& vertex, int column,
                                  int row) const {
    const auto seen = [&](const Source& source) {
        const glm::vec3 coordinates(vertex.direction + vertex.inverseDepth * source.offset);
        return toVec3(source.sampler.sample(coordinates));
    };
    glm::vec3 radiance(0.0f);
    if (m_a && vertex.weightA > 0.0)
        radiance += float(vertex.weightA) * seen(*m_a);
    if (m_b && vertex.weightB > 0.0)
        radiance += float(vertex.weightB) * seen(*m_b);
    m_map.radiance.at(faceIndex, column, row) = radiance;
    m_map.distance.at(faceIndex, column, row) = vertex.sky ? kInfinity : float(vertex.distance);
    m_map.uncovered.at(faceIndex, column, row) = vertex.uncovered ? 1 : 0;
}

}  // namespace reflet
