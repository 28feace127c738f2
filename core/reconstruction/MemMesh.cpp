// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/MemMesh.h"

#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kVerticesPerTask = 256;

/// First texel whose centre is not below the coordinate.
int firstTexelFrom(int resolution, double coordinate) {
    int texel = std::clamp(int(std::floor((coordinate + 1.0) * 0.5 * resolution)), 0, resolution);
    while (texel > 0 && texelCoordinate(resolution, texel - 1) >= coordinate)
        --texel;
    while (texel < resolution && texelCoordinate(resolution, texel) < coordinate)
        ++texel;
    return texel;
}

/// Halvings of a quad of `edge` texels until its children would fall below the smallest allowed.
int halvings(double edge, double smallest) {
    int count = 0;
    for (const double limit = std::max(smallest, 1.0); 0.5 * edge >= limit; edge *= 0.5)
        ++count;
    return count;
}

/// Which REMs may serve a vertex in the paper's weighting, as one number.
int service(const MemVertex& vertex) {
    const int fallback = vertex.uncovered && vertex.weightB > 0.0 ? 1 : 0;
    return (vertex.validA ? 8 : 0) + (vertex.validB ? 4 : 0) + (vertex.sky ? 2 : 0) + fallback;
}

}  // namespace

TexelRange texelsWithin(int resolution, double from, double to) {
    return {firstTexelFrom(resolution, from), firstTexelFrom(resolution, to)};
}

MemMeshBuilder::MemMeshBuilder(const MemVertexTracer& tracer, int face, const MemSettings& settings)
    : m_tracer(tracer),
      m_settings(settings),
      m_faceIndex(face),
      m_meshSize(std::clamp(settings.meshSize, 1, settings.resolution)) {
    assert(settings.resolution >= 1);
    m_levels = halvings(double(settings.resolution) / m_meshSize, settings.smallestQuad);
    m_units = m_meshSize << m_levels;
    m_index.assign(std::size_t(m_units + 1) * std::size_t(m_units + 1), kNoVertex);
    const int size = 1 << m_levels;
    for (int j = 0; j < m_meshSize; ++j) {
        for (int i = 0; i < m_meshSize; ++i)
            m_level.push_back({i * size, j * size, size});
    }
}

bool MemMeshBuilder::beginLevel() {
    m_quads.clear();
    for (const Square& square : m_level)
        m_quads.push_back(quadOf(square));
    return !m_level.empty();
}

/// Rays through the middles of quads whose corners alone do not ask for a split already. They
/// become corners where a quad is divided.
void MemMeshBuilder::askMiddles() {
    if (!(m_settings.errorBound > 0.0))
        return;
    for (std::size_t k = 0; k < m_level.size(); ++k) {
        const Square& square = m_level[k];
        if (square.size > 1 && servedAlike(m_quads[k]))
            static_cast<void>(vertexAt(square.i + square.size / 2, square.j + square.size / 2));
    }
}

void MemMeshBuilder::divideLevel() {
    const bool toTexels = m_settings.traceEdgeTexels && m_settings.smallestQuad <= 1.0;
    std::vector<Square> children;
    for (std::size_t k = 0; k < m_level.size(); ++k) {
        if (!wantsSplit(m_level[k], m_quads[k])) {
            m_face.quads.push_back(m_quads[k]);
        } else if (m_level[k].size > 1) {
            divide(m_level[k], children);
        } else if (toTexels) {
            divideIntoTexels(m_quads[k]);
        } else {
            m_face.quads.push_back(m_quads[k]);
        }
    }
    m_level.swap(children);
}

MemQuad MemMeshBuilder::quadOf(const Square& square) {
    const int i1 = square.i + square.size;
    const int j1 = square.j + square.size;
    return {coordinate(square.i),
            coordinate(square.j),
            coordinate(i1),
            coordinate(j1),
            {vertexAt(square.i, square.j), vertexAt(i1, square.j), vertexAt(square.i, j1),
             vertexAt(i1, j1)}};
}

std::uint32_t MemMeshBuilder::vertexAt(int i, int j) {
    std::uint32_t& index = m_index[std::size_t(j) * std::size_t(m_units + 1) + std::size_t(i)];
    if (index == kNoVertex)
        index = addVertex({coordinate(i), coordinate(j)});
    return index;
}

std::uint32_t MemMeshBuilder::addVertex(const glm::dvec2& st) {
    m_face.vertices.emplace_back().direction = faceDirection(m_faceIndex, st);
    return std::uint32_t(m_face.vertices.size() - 1);
}

bool MemMeshBuilder::wantsSplit(const Square& square, const MemQuad& quad) {
    if (m_settings.errorBound > 0.0)
        return !servedAlike(quad) || lookupError(square, quad) > m_settings.errorBound;
    if (std::isinf(m_settings.depthRatio))
        return false;
    if (m_settings.depthRatio <= 0.0)
        return true;
    return differsInDepth(quad) || (m_settings.refineAtValidity && !servedAlike(quad));
}

/// |Zi − Zj| / min(Zi, Zj) is largest for the farthest and the nearest of the four corners, so that
/// one comparison covers all pairs, diagonals included.
bool MemMeshBuilder::differsInDepth(const MemQuad& quad) const {
    const std::vector<MemVertex>& v = m_face.vertices;
    const auto [nearest, farthest] =
        std::minmax({v[quad.vertex[0]].distance, v[quad.vertex[1]].distance,
                     v[quad.vertex[2]].distance, v[quad.vertex[3]].distance});
    return farthest - nearest > m_settings.depthRatio * nearest;
}

bool MemMeshBuilder::servedAlike(const MemQuad& quad) {
    if (m_tracer.weighting() == Weighting::BySight)
        return servedAlikeBySight(quad);
    const std::vector<MemVertex>& v = m_face.vertices;
    const int first = service(v[quad.vertex[0]]);
    return std::all_of(quad.vertex.begin() + 1, quad.vertex.end(),
                       [&](std::uint32_t k) { return service(v[k]) == first; });
}

/// How far apart q is as interpolated to the quad's middle and as its own ray says, in texels of
/// the map. A smallest quad has no middle: there the corners tell how far they are from a plane, on
/// which the two halves of the sum of 1/z along the diagonals are equal.
double MemMeshBuilder::lookupError(const Square& square, const MemQuad& quad) const {
    const std::vector<MemVertex>& v = m_face.vertices;
    const std::array<double, 4> w{v[quad.vertex[0]].inverseDepth, v[quad.vertex[1]].inverseDepth,
                                  v[quad.vertex[2]].inverseDepth, v[quad.vertex[3]].inverseDepth};
    const double mean = 0.25 * (w[0] + w[1] + w[2] + w[3]);
    double middle = 0.5 * (w[0] + w[3]);
    if (square.size > 1) {
        const std::uint32_t index =
            m_index[std::size_t(square.j + square.size / 2) * std::size_t(m_units + 1) +
                    std::size_t(square.i + square.size / 2)];
        const MemVertex& own = v[index];
        if (own.sky != v[quad.vertex[0]].sky || own.uncovered != v[quad.vertex[0]].uncovered)
            return kInfinity;
        middle = own.inverseDepth;
    }
    const glm::dvec3 direction =
        faceDirection(m_faceIndex, {0.5 * (quad.s0 + quad.s1), 0.5 * (quad.t0 + quad.t1)});
    double error = 0.0;
    for (const std::uint32_t k : quad.vertex) {
        for (const std::int8_t rem : {v[k].a, v[k].b}) {
            if (rem < 0)
                continue;
            const glm::dvec3 offset = m_tracer.offset(rem);
            const glm::dvec3 ours = glm::normalize(direction + mean * offset);
            const glm::dvec3 truth = glm::normalize(direction + middle * offset);
            error = std::max(error, glm::distance(ours, truth));
        }
    }
    return error * m_settings.resolution / (0.5 * kPi);
}

/// By sight, weights fade where one REM takes over from another, and that parts no corners. What
/// does: a REM that serves one corner and is blind for another.
bool MemMeshBuilder::servedAlikeBySight(const MemQuad& quad) {
    std::vector<MemVertex>& v = m_face.vertices;
    const MemVertex& first = v[quad.vertex[0]];
    for (const std::uint32_t k : quad.vertex) {
        if (v[k].sky != first.sky || v[k].uncovered != first.uncovered ||
            (v[k].uncovered && v[k].a != first.a)) {
            return false;
        }
    }
    if (first.uncovered)
        return true;
    for (const std::uint32_t k : quad.vertex) {
        for (const std::int8_t rem : {v[k].a, v[k].b}) {
            for (const std::uint32_t other : quad.vertex) {
                if (rem >= 0 && !m_tracer.sees(rem, v[other]))
                    return false;
            }
        }
    }
    return true;
}

void MemMeshBuilder::divide(const Square& square, std::vector<Square>& children) const {
    const int half = square.size / 2;
    for (const int j : {square.j, square.j + half}) {
        for (const int i : {square.i, square.i + half})
            children.push_back({i, j, half});
    }
}

/// Cuts a finest quad along the borders of the texels whose centres it holds, one leaf per texel,
/// each with a ray of its own. A quad that holds no centre is never looked at and stays whole.
void MemMeshBuilder::divideIntoTexels(const MemQuad& quad) {
    const int n = m_settings.resolution;
    const TexelRange columns = texelsWithin(n, quad.s0, quad.s1);
    const TexelRange rows = texelsWithin(n, quad.t0, quad.t1);
    if (columns.empty() || rows.empty()) {
        m_face.quads.push_back(quad);
        return;
    }
    const auto border = [n](int texel) { return double(2 * texel) / double(n) - 1.0; };
    for (int row = rows.first; row < rows.last; ++row) {
        const double t0 = row == rows.first ? quad.t0 : border(row);
        const double t1 = row + 1 == rows.last ? quad.t1 : border(row + 1);
        for (int column = columns.first; column < columns.last; ++column) {
            const double s0 = column == columns.first ? quad.s0 : border(column);
            const double s1 = column + 1 == columns.last ? quad.s1 : border(column + 1);
            const std::uint32_t vertex =
                addVertex({texelCoordinate(n, column), texelCoordinate(n, row)});
            m_face.quads.push_back({s0, t0, s1, t1, {vertex, vertex, vertex, vertex}});
        }
    }
}

namespace {

/// Traces what several builders ask for, as one stream of rays.
class VertexStream {
public:
    VertexStream(const MemVertexTracer& tracer, std::vector<MemMeshBuilder>& builders)
        : m_tracer(tracer), m_builders(builders) {}

    void trace() {
        m_directions.clear();
        m_vertices.clear();
        for (MemMeshBuilder& builder : m_builders) {
            for (MemVertex& vertex : builder.newVertices()) {
                m_directions.push_back(vertex.direction);
                m_vertices.push_back(&vertex);
            }
        }
        m_t.resize(m_directions.size());
        m_tracer.heightfield().traceFrom(m_tracer.position(), m_directions, {m_t, {}});
        parallelFor(0, m_vertices.size(), kVerticesPerTask,
                    [&](std::size_t first, std::size_t last) {
                        for (std::size_t k = first; k < last; ++k)
                            *m_vertices[k] = m_tracer.at(m_directions[k], m_t[k]);
                    });
        for (MemMeshBuilder& builder : m_builders)
            builder.markTraced();
    }

private:
    const MemVertexTracer& m_tracer;
    std::vector<MemMeshBuilder>& m_builders;
    std::vector<glm::dvec3> m_directions;
    std::vector<MemVertex*> m_vertices;
    std::vector<double> m_t;
};

}  // namespace

std::vector<MemFace> buildMemMesh(const MemVertexTracer& tracer, std::span<const int> faces,
                                  const MemSettings& settings) {
    std::vector<MemMeshBuilder> builders;
    for (const int face : faces)
        builders.emplace_back(tracer, face, settings);
    const auto forEach = [&](const auto& step) {
        parallelFor(0, builders.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k)
                step(builders[k]);
        });
    };
    VertexStream stream(tracer, builders);
    for (;;) {
        std::atomic<bool> busy{false};
        forEach([&](MemMeshBuilder& builder) {
            if (builder.beginLevel())
                busy = true;
        });
        stream.trace();
        if (!busy)
            break;
        if (settings.errorBound > 0.0) {
            forEach([](MemMeshBuilder& builder) { builder.askMiddles(); });
            stream.trace();
        }
        forEach([](MemMeshBuilder& builder) { builder.divideLevel(); });
    }
    std::vector<MemFace> meshes;
    for (MemMeshBuilder& builder : builders)
        meshes.push_back(builder.take());
    return meshes;
}

std::vector<MemFace> buildMemFaces(const ReconstructionInput& input,
                                   const RemCandidates& candidates, const glm::dvec3& position,
                                   const MemSettings& settings) {
    const MemVertexTracer tracer(input, candidates, position, settings.refineHits);
    constexpr std::array<int, 6> kFaces{0, 1, 2, 3, 4, 5};
    return buildMemMesh(tracer, kFaces, settings);
}

MemFace buildMemFace(const ReconstructionInput& input, const RemCandidates& candidates,
                     const glm::dvec3& position, int face, const MemSettings& settings) {
    const MemVertexTracer tracer(input, candidates, position, settings.refineHits);
    return std::move(buildMemMesh(tracer, {&face, 1}, settings).front());
}

}  // namespace reflet
