// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/MemVertexTracer.h"

#include "core/reconstruction/SurfaceRefinement.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace reflet {

namespace {
/// Metres. A position inside a column meets it at once; 1/z stays finite all the same.
constexpr double kSmallestDepth = 1e-6;
/// How far a hit may move; measured on two cities: 2, 4 and 8 cells give 0.08 dB between them.
constexpr double kReachInCells = 4.0;
/// Metres; keeps weights finite where a REM stands at the vehicle.
constexpr double kLeastSkyPenalty = 1e-6;
constexpr double kHalfSquareDiagonal = 0.70710678118654752440;
}  // namespace

double validityTolerance(const GridSpec& grid) {
    return kHalfSquareDiagonal * grid.cellSize;
}

double refinementReach(const GridSpec& grid) {
    return kReachInCells * grid.cellSize;
}

MemVertexTracer::MemVertexTracer(const ReconstructionInput& input, const RemCandidates& candidates,
                                 const glm::dvec3& position, bool refineHits)
    : m_tracer(*input.tracer),
      m_weighting(candidates.weighting),
      m_position(position),
      m_sceneDiameter(input.sceneDiameter),
      m_reach(refineHits ? refinementReach(input.tracer->grid()) : 0.0),
      m_tolerance(validityTolerance(input.tracer->grid())) {
    assert(candidates.rems.size() <= m_candidates.size());
    for (const RemCandidate& candidate : candidates.rems) {
        const ReferenceEnvironmentMap& rem = input.rems[candidate.rem];
        const double penalty = glm::distance(rem.center, position) + kLeastSkyPenalty;
        m_candidates[m_count++] = {&rem, candidate.presence, penalty / candidate.presence};
    }
    if (m_weighting == Weighting::AsInPaper && m_count == 2) {
        m_blendOfSky =
            blendParameter(m_candidates[0].rem->center, m_candidates[1].rem->center, position);
    }
}

MemVertex MemVertexTracer::trace(const glm::dvec3& direction) const {
    const HeightfieldHit hit = m_tracer.trace({m_position, direction});
    return at(direction, hit.hit ? hit.t : double(kInfinity));
}

MemVertex MemVertexTracer::at(const glm::dvec3& direction, double t) const {
    MemVertex vertex;
    vertex.direction = direction;
    vertex.sky = std::isinf(t);
    if (vertex.sky) {
        vertex.distance = m_sceneDiameter;
    } else {
        vertex.inverseDepth = 1.0 / std::max(t, kSmallestDepth);
        vertex.distance = t * glm::length(direction);
        vertex.point = m_position + t * direction;
    }
    weigh(vertex);
    if (m_reach > 0.0 && !vertex.sky && !vertex.uncovered)
        refine(vertex);
    return vertex;
}

/// By the distances of the REM that weighs more: where both are valid they show the same surface.
void MemVertexTracer::refine(MemVertex& vertex) const {
    const std::int8_t heavier = vertex.weightA >= vertex.weightB ? vertex.a : vertex.b;
    const double hit = 1.0 / vertex.inverseDepth;
    const Ray ray{m_position, vertex.direction};
    const std::optional<double> t =
        refineOnSurface(*m_candidates[std::size_t(heavier)].rem, ray, hit, m_reach);
    if (!t)
        return;
    vertex.inverseDepth = 1.0 / std::max(*t, kSmallestDepth);
    vertex.distance = *t * glm::length(vertex.direction);
    vertex.point = ray.at(*t);
}

bool MemVertexTracer::sees(std::int8_t candidate, MemVertex& vertex) const {
    const auto bit = std::uint16_t(1U << unsigned(candidate));
    if ((vertex.tested & bit) == 0) {
        const ReferenceEnvironmentMap& rem = *m_candidates[std::size_t(candidate)].rem;
        const bool valid = vertex.sky ? isValidSky(rem, vertex.direction)
                                      : isValid(rem, vertex.point, m_tolerance);
        vertex.tested |= bit;
        vertex.seenBy |= valid ? bit : std::uint16_t(0);
    }
    return (vertex.seenBy & bit) != 0;
}

void MemVertexTracer::weigh(MemVertex& vertex) const {
    if (m_count == 0)
        vertex.uncovered = true;
    else if (m_weighting == Weighting::AsInPaper)
        weighAsInPaper(vertex);
    else
        weighBySight(vertex);
}

/// With the penalties p1 <= p2 <= p3 of the three best REMs that see the point, the first two weigh
/// 1/p − 1/p3, normalised (Buehler et al. 2001, section 4.2): a REM has no weight any more when
/// another takes its place. A presence that fades makes a penalty grow without bound, so that REMs
/// come and go as the third, or the fourth, or not at all.
void MemVertexTracer::weighBySight(MemVertex& vertex) const {
    struct Option {
        double penalty;
        std::int8_t candidate;
    };
    std::array<Option, kMostCandidates> options;
    for (std::size_t i = 0; i < m_count; ++i) {
        const Candidate& candidate = m_candidates[i];
        const double penalty = vertex.sky
                                   ? candidate.skyPenalty
                                   : sightPenalty(m_position, candidate.rem->center, vertex.point) /
                                         candidate.presence;
        std::size_t place = i;
        for (; place > 0 && penalty < options[place - 1].penalty; --place)
            options[place] = options[place - 1];
        options[place] = {penalty, std::int8_t(i)};
    }
    std::array<Option, 3> best;
    std::size_t found = 0;
    for (std::size_t i = 0; i < m_count && found < best.size(); ++i) {
        if (sees(options[i].candidate, vertex))
            best[found++] = options[i];
    }
    if (found == 0) {
        fallBack(vertex);
        return;
    }
    const double least = found == 3 ? 1.0 / best[2].penalty : 0.0;
    const double first = 1.0 / best[0].penalty - least;
    const double second = found > 1 ? 1.0 / best[1].penalty - least : 0.0;
    vertex.a = best[0].candidate;
    vertex.validA = true;
    // Three alike share nothing: then the first is as good as any.
    vertex.weightB = first + second > 0.0 ? second / (first + second) : 0.0;
    vertex.weightA = 1.0 - vertex.weightB;
    vertex.validB = vertex.weightB > 0.0;
    vertex.b = vertex.validB ? best[1].candidate : std::int8_t(-1);
}

/// Nobody sees it: the REM that comes nearest to it shows what stands beside it.
void MemVertexTracer::fallBack(MemVertex& vertex) const {
    vertex.uncovered = true;
    double best = -1.0;
    for (std::size_t i = 0; i < m_count; ++i) {
        const ReferenceEnvironmentMap& rem = *m_candidates[i].rem;
        const glm::dvec3 towards = vertex.sky ? vertex.direction : vertex.point - rem.center;
        const double seen = seenDistance(rem, towards);
        const double share = vertex.sky ? seen : seen / glm::length(towards);
        if (share > best) {
            best = share;
            vertex.a = std::int8_t(i);
        }
    }
}

/// W_A = 1 − s, W_B = s; what is not valid gets 0 and the other takes all. With both invalid the
/// one that had the higher weight is shown (paper, end of section 4.3), A when they are equal.
void MemVertexTracer::weighAsInPaper(MemVertex& vertex) const {
    double s = 0.0;
    vertex.a = 0;
    vertex.validA = sees(0, vertex);
    if (m_count > 1) {
        vertex.b = 1;
        vertex.validB = sees(1, vertex);
        s = vertex.sky ? m_blendOfSky
                       : blendParameter(m_candidates[0].rem->center, m_candidates[1].rem->center,
                                        vertex.point);
    }
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
