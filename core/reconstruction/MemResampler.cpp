// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/MemResampler.h"

#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemMesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

/// Below this the texels that pass say less about I than rounding does.
constexpr float kSmallestWeight = 1e-4f;

/// A value at the corners (s0,t0) (s1,t0) (s0,t1) (s1,t1) of a leaf, read at (u, v) in [0, 1]².
template <class T>
T bilinear(const std::array<T, 4>& corner, double u, double v) {
    const T top = corner[0] + u * (corner[1] - corner[0]);
    const T bottom = corner[2] + u * (corner[3] - corner[2]);
    return top + v * (bottom - top);
}

/// The centre of a REM lies on the interpolated surface: any direction is as good as another.
glm::dvec3 orElse(const glm::dvec3& coordinates, const glm::dvec3& direction) {
    return coordinates == glm::dvec3(0.0) ? direction : coordinates;
}

}  // namespace

/// What is interpolated over a leaf. Vectors are kept only for the linear form of the paper.
struct MemResampler::Leaf {
    std::array<double, 4> inverseDepth{};
    std::array<double, 4> weightB{};
    std::array<glm::dvec3, 4> fromA{};  ///< C_A → I
    std::array<glm::dvec3, 4> fromB{};
    bool usesA = false;
    bool usesB = false;
    bool uncovered = false;
};

MemResampler::MemResampler(const ReconstructionInput& input, const RemChoice& choice,
                           const glm::dvec3& position, Interpolation interpolation,
                           LocalEnvironmentMap& map)
    : m_interpolation(interpolation),
      m_sceneDiameter(input.sceneDiameter),
      m_tolerance(validityTolerance(input.tracer->grid())),
      m_map(map) {
    const auto source = [&](const std::optional<std::size_t>& index) {
        if (!index)
            return Source{};
        const ReferenceEnvironmentMap& rem = input.rems[*index];
        return Source{&rem, position - rem.center};
    };
    m_a = source(choice.a);
    m_b = source(choice.b);
}

void MemResampler::writeLeaf(int faceIndex, const MemFace& face, const MemQuad& quad) const {
    const int n = m_map.radiance.resolution();
    const TexelRange columns = texelsWithin(n, quad.s0, quad.s1);
    const TexelRange rows = texelsWithin(n, quad.t0, quad.t1);
    if (columns.empty() || rows.empty())
        return;
    if (quad.vertex[0] == quad.vertex[3]) {
        writeTexelLeaf(faceIndex, face.vertices[quad.vertex[0]], columns.first, rows.first);
        return;
    }
    const Leaf leaf = prepare(face, quad);
    for (int row = rows.first; row < rows.last; ++row) {
        const double t = texelCoordinate(n, row);
        const double v = (t - quad.t0) / (quad.t1 - quad.t0);
        for (int column = columns.first; column < columns.last; ++column) {
            const double s = texelCoordinate(n, column);
            const double u = (s - quad.s0) / (quad.s1 - quad.s0);
            const glm::dvec3 direction = faceDirection(faceIndex, {s, t});
            const double inverseDepth = bilinear(leaf.inverseDepth, u, v);
            m_map.radiance.at(faceIndex, column, row) =
                radianceAt(leaf, direction, inverseDepth, u, v);
            m_map.distance.at(faceIndex, column, row) =
                inverseDepth > 0.0 ? float(glm::length(direction) / inverseDepth) : kInfinity;
            m_map.uncovered.at(faceIndex, column, row) = leaf.uncovered ? 1 : 0;
        }
    }
}

void MemResampler::writeTexelLeaf(int faceIndex, const MemVertex& vertex, int column,
                                  int row) const {
    glm::vec3 radiance(0.0f);
    if (m_a.rem && vertex.weightA > 0.0)
        radiance += float(vertex.weightA) * radianceSeen(m_a, vertex);
    if (m_b.rem && vertex.weightB > 0.0)
        radiance += float(vertex.weightB) * radianceSeen(m_b, vertex);
    m_map.radiance.at(faceIndex, column, row) = radiance;
    m_map.distance.at(faceIndex, column, row) = vertex.sky ? kInfinity : float(vertex.distance);
    m_map.uncovered.at(faceIndex, column, row) = vertex.uncovered ? 1 : 0;
}

/// Looks I up among the texels that pass the validity test of their own: next to a silhouette the
/// bilinear footprint reaches over to the thing in front, whose colour is not I's.
glm::vec3 MemResampler::radianceSeen(const Source& source, const MemVertex& vertex) const {
    const ReferenceEnvironmentMap& rem = *source.rem;
    const glm::dvec3 coordinates =
        orElse(vertex.direction + vertex.inverseDepth * source.offset, vertex.direction);
    if (vertex.uncovered || rem.distance.resolution() != rem.radiance.resolution()) {
        return sampleBilinear(rem.radiance, coordinates);
    }
    const float nearest =
        vertex.sky ? kInfinity : float(glm::length(vertex.point - rem.center) - m_tolerance);
    const BilinearFootprint footprint = bilinearFootprint(rem.radiance.resolution(), coordinates);
    glm::vec3 sum(0.0f);
    float weight = 0.0f;
    int passed = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Texel& texel = footprint.texel[k];
        if (rem.distance.at(texel.face, texel.column, texel.row) < nearest)
            continue;
        sum += footprint.weight[k] * rem.radiance.at(texel.face, texel.column, texel.row);
        weight += footprint.weight[k];
        ++passed;
    }
    if (passed == 4 || weight < kSmallestWeight)
        return sampleBilinear(rem.radiance, coordinates);
    return sum / weight;
}

MemResampler::Leaf MemResampler::prepare(const MemFace& face, const MemQuad& quad) const {
    Leaf leaf;
    for (std::size_t k = 0; k < 4; ++k) {
        const MemVertex& vertex = face.vertices[quad.vertex[k]];
        leaf.inverseDepth[k] = vertex.inverseDepth;
        leaf.weightB[k] = vertex.weightB;
        leaf.usesA = leaf.usesA || vertex.weightA > 0.0;
        leaf.usesB = leaf.usesB || vertex.weightB > 0.0;
        leaf.uncovered = leaf.uncovered || vertex.uncovered;
        if (m_interpolation == Interpolation::Exact)
            continue;
        const glm::dvec3 sky = m_sceneDiameter * glm::normalize(vertex.direction);
        if (m_a.rem)
            leaf.fromA[k] = vertex.sky ? sky : vertex.point - m_a.rem->center;
        if (m_b.rem)
            leaf.fromB[k] = vertex.sky ? sky : vertex.point - m_b.rem->center;
    }
    leaf.usesA = leaf.usesA && m_a.rem;
    leaf.usesB = leaf.usesB && m_b.rem;
    return leaf;
}

/// Exact: I = P + z d′, so that C→I = z (d′ + (P − C)/z), and the factor z does not matter to a
/// lookup by direction. On a plane 1/z is affine in (s, t); bilinear interpolation reproduces it.
glm::vec3 MemResampler::radianceAt(const Leaf& leaf, const glm::dvec3& direction,
                                   double inverseDepth, double u, double v) const {
    const auto lookUp = [&](const Source& source, const std::array<glm::dvec3, 4>& corners) {
        const glm::dvec3 coordinates = m_interpolation == Interpolation::Exact
                                           ? direction + inverseDepth * source.offset
                                           : bilinear(corners, u, v);
        return sampleBilinear(source.rem->radiance, orElse(coordinates, direction));
    };
    if (!leaf.usesB)
        return leaf.usesA ? lookUp(m_a, leaf.fromA) : glm::vec3(0.0f);
    if (!leaf.usesA)
        return lookUp(m_b, leaf.fromB);
    const auto weightB = float(bilinear(leaf.weightB, u, v));
    return (1.0f - weightB) * lookUp(m_a, leaf.fromA) + weightB * lookUp(m_b, leaf.fromB);
}

}  // namespace reflet
