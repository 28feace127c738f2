// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/MemResampler.h"

#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemMesh.h"

#include <glm/common.hpp>
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
    /// A REM that serves one of the corners.
    struct Look {
        std::int8_t candidate = -1;
        LeafScalar weight;  ///< of the corners, adding up to 1 over the looks
        std::array<glm::vec3, 4> corners;
        std::optional<LeafLookup> lookup;
    };

    TexelRange columns;
    TexelRange rows;
    LeafScalar inverseDepth;
    static constexpr std::size_t kMostLooks = 8;  ///< four corners, two REMs each
    std::array<Look, kMostLooks> looks;
    std::size_t count = 0;
    bool uncovered = false;

    [[nodiscard]] Look& lookOf(std::int8_t candidate) {
        std::size_t i = 0;
        while (i < count && looks[i].candidate != candidate)
            ++i;
        if (i == count)
            looks[count++].candidate = candidate;
        return looks[i];
    }
};

MemResampler::MemResampler(const ReconstructionInput& input, const RemCandidates& candidates,
                           const glm::dvec3& position, Interpolation interpolation,
                           LocalEnvironmentMap& map, TexelSources* sources)
    : m_interpolation(interpolation),
      m_sceneDiameter(input.sceneDiameter),
      m_map(map),
      m_texelSources(sources) {
    for (const RemCandidate& candidate : candidates.rems) {
        const ReferenceEnvironmentMap& rem = input.rems[candidate.rem];
        m_sources.push_back(
            {&rem, candidate.rem, CubeSampler(rem.radiance), position - rem.center});
    }
}

void MemResampler::writeLeaf(int faceIndex, const MemFace& face, const MemQuad& quad) const {
    const int n = m_map.radiance.resolution();
    if (quad.vertex[0] == quad.vertex[3]) {
        const int column = texelsWithin(n, quad.s0, quad.s1).first;
        const int row = texelsWithin(n, quad.t0, quad.t1).first;
        writeTexel(faceIndex, face.vertices[quad.vertex[0]], column, row);
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
    for (std::size_t k = 0; k < 4; ++k) {
        const MemVertex& vertex = face.vertices[quad.vertex[k]];
        leaf.inverseDepth.corner[k] = float(vertex.inverseDepth);
        leaf.uncovered = leaf.uncovered || vertex.uncovered;
        if (vertex.a >= 0 && vertex.weightA > 0.0)
            leaf.lookOf(vertex.a).weight.corner[k] += float(vertex.weightA);
        if (vertex.b >= 0 && vertex.weightB > 0.0)
            leaf.lookOf(vertex.b).weight.corner[k] += float(vertex.weightB);
    }
    const int texels =
        (leaf.columns.last - leaf.columns.first) * (leaf.rows.last - leaf.rows.first);
    for (std::size_t i = 0; i < leaf.count; ++i) {
        Leaf::Look& look = leaf.looks[i];
        const Source& source = m_sources[std::size_t(look.candidate)];
        look.corners = lookups(source, face, quad);
        look.lookup.emplace(source.sampler, look.corners, texels >= kManyTexels);
    }
    return leaf;
}

/// I = P + z d′, so that C→I = z (d′ + (P − C)/z), and the factor z does not matter to a lookup by
/// direction. On a plane 1/z is affine in (s, t), and with it the bracket: interpolated bilinearly
/// between the corners it is exact. The paper interpolates C→I itself, which is not.
std::array<glm::vec3, 4> MemResampler::lookups(const Source& source, const MemFace& face,
                                               const MemQuad& quad) const {
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
    return corners;
}

void MemResampler::writeRun(int faceIndex, int row, int column, const Leaf& leaf,
                            const TexelRun& run) const {
    std::array<Float4, TexelRun::kMost> radiance, other;
    const auto count = std::size_t(run.count);
    if (leaf.count == 0)
        radiance.fill(Float4{});
    else
        leaf.looks[0].lookup->read(run, radiance);
    if (leaf.count > 1) {
        const LeafScalar::Line weight = leaf.looks[0].weight.along(run.v);
        for (std::size_t i = 0; i < count; ++i)
            radiance[i] *= weight.at(run.u[i]);
    }
    for (std::size_t k = 1; k < leaf.count; ++k) {
        leaf.looks[k].lookup->read(run, other);
        const LeafScalar::Line weight = leaf.looks[k].weight.along(run.v);
        for (std::size_t i = 0; i < count; ++i)
            radiance[i] += weight.at(run.u[i]) * other[i];
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
    if (m_texelSources)
        writeSources(faceIndex, row, column, leaf, run);
}

void MemResampler::writeSources(int faceIndex, int row, int column, const Leaf& leaf,
                                const TexelRun& run) const {
    for (int i = 0; i < run.count; ++i) {
        auto& texel = m_texelSources->at(faceIndex, column + i, row);
        texel = {};
        for (std::size_t k = 0; k < leaf.count; ++k) {
            const Leaf::Look& look = leaf.looks[k];
            const float u = run.u[std::size_t(i)];
            const glm::vec3 from = glm::mix(look.corners[0], look.corners[2], run.v);
            const glm::vec3 to = glm::mix(look.corners[1], look.corners[3], run.v);
            const TexelSource source{std::int32_t(m_sources[std::size_t(look.candidate)].index),
                                     look.weight.along(run.v).at(u), glm::mix(from, to, u)};
            if (source.weight > texel[0].weight) {
                texel[1] = texel[0];
                texel[0] = source;
            } else if (source.weight > texel[1].weight) {
                texel[1] = source;
            }
        }
    }
}

void MemResampler::writeTexel(int faceIndex, const MemVertex& vertex, int column, int row) const {
    glm::vec3 radiance(0.0f);
    std::array<TexelSource, 2> sources;
    const auto add = [&](std::int8_t candidate, double weight, TexelSource& used) {
        if (candidate < 0 || !(weight > 0.0))
            return;
        const Source& source = m_sources[std::size_t(candidate)];
        const glm::vec3 lookup(vertex.direction + vertex.inverseDepth * source.offset);
        radiance += float(weight) * toVec3(source.sampler.sample(lookup));
        used = {std::int32_t(source.index), float(weight), lookup};
    };
    const bool first = vertex.weightA >= vertex.weightB;
    add(vertex.a, vertex.weightA, sources[first ? 0 : 1]);
    add(vertex.b, vertex.weightB, sources[first ? 1 : 0]);
    if (m_texelSources)
        m_texelSources->at(faceIndex, column, row) = sources;
    m_map.radiance.at(faceIndex, column, row) = radiance;
    m_map.distance.at(faceIndex, column, row) = vertex.sky ? kInfinity : float(vertex.distance);
    m_map.uncovered.at(faceIndex, column, row) = vertex.uncovered ? 1 : 0;
}

}  // namespace reflet
