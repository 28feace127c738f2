// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/MemVertexTracer.h"

#include "core/reconstruction/SurfaceRefinement.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>

namespace reflet {

namespace {
/// Metres. A position inside a column meets it at once; 1/z stays finite all the same.
constexpr double kSmallestDepth = 1e-6;
/// How far a hit may move; measured on two cities: 2, 4 and 8 cells give 0.08 dB between them.
constexpr double kReachInCells = 4.0;
constexpr double kHalfSquareDiagonal = 0.70710678118654752440;
}  // namespace

double validityTolerance(const GridSpec& grid) {
    return kHalfSquareDiagonal * grid.cellSize;
}

MemVertexTracer::MemVertexTracer(const ReconstructionInput& input, const RemChoice& choice,
                                 const glm::dvec3& position, bool refineHits)
    : m_tracer(*input.tracer),
      m_a(choice.a ? &input.rems[*choice.a] : nullptr),
      m_b(choice.b ? &input.rems[*choice.b] : nullptr),
      m_position(position),
      m_sceneDiameter(input.sceneDiameter),
      m_reach(refineHits ? kReachInCells * input.tracer->grid().cellSize : 0.0),
      m_tolerance(validityTolerance(input.tracer->grid())),
      m_blendOfSky(m_a && m_b ? blendParameter(m_a->center, m_b->center, position) : 0.0) {
    assert((m_a || !m_b) && "the nearer REM comes first");
}

MemVertex MemVertexTracer::trace(const glm::dvec3& direction) const {
    MemVertex vertex;
    vertex.direction = direction;
    const HeightfieldHit hit = m_tracer.trace({m_position, direction});
    vertex.sky = !hit.hit;
    if (hit.hit) {
        vertex.inverseDepth = 1.0 / std::max(hit.t, kSmallestDepth);
        vertex.distance = hit.t * glm::length(direction);
        vertex.point = m_position + hit.t * direction;
    } else {
        vertex.distance = m_sceneDiameter;
    }
    weigh(vertex);
    if (m_reach > 0.0 && hit.hit && !vertex.uncovered)
        refine(vertex);
    return vertex;
}

/// By the distances of the REM that weighs more: where both are valid they show the same surface.
void MemVertexTracer::refine(MemVertex& vertex) const {
    const bool first = vertex.weightA >= vertex.weightB;
    const double hit = 1.0 / vertex.inverseDepth;
    const Ray ray{m_position, vertex.direction};
    const std::optional<double> t = refineOnSurface(first ? *m_a : *m_b, ray, hit, m_reach);
    if (!t)
        return;
    vertex.inverseDepth = 1.0 / std::max(*t, kSmallestDepth);
    vertex.distance = *t * glm::length(vertex.direction);
    vertex.point = ray.at(*t);
}

bool MemVertexTracer::sees(const ReferenceEnvironmentMap* rem, const MemVertex& vertex) const {
    if (!rem)
        return false;
    return vertex.sky ? isValidSky(*rem, vertex.direction)
                      : isValid(*rem, vertex.point, m_tolerance);
}

/// W_A = 1 − s, W_B = s; what is not valid gets 0 and the other takes all. With both invalid the
/// one that had the higher weight is shown (paper, end of section 4.3), A when they are equal.
void MemVertexTracer::weigh(MemVertex& vertex) const {
    double s = 0.0;
    if (m_a && m_b) {
        s = vertex.sky ? m_blendOfSky : blendParameter(m_a->center, m_b->center, vertex.point);
    }
    vertex.validA = sees(m_a, vertex);
    vertex.validB = sees(m_b, vertex);
    vertex.uncovered = !vertex.validA && !vertex.validB;
    if (vertex.uncovered) {
        s = s > 0.5 ? 1.0 : 0.0;
    } else if (!vertex.validB) {
        s = 0.0;
    } else if (!vertex.validA) {
        s = 1.0;
    }
    vertex.weightA = 1.0 - s;
    vertex.weightB = s;
}

}  // namespace reflet
