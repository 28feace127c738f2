// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/Reconstruction.h"

namespace reflet {

/// Half a cell's diagonal, seen from above: how much nearer than I the surface in a REM's distance
/// map may lie before the REM counts as blind for I. The heightfield knows no better where I is.
[[nodiscard]] double validityTolerance(const GridSpec& grid);
/// Metres by which MemSettings::refineHits may move a hit.
[[nodiscard]] double refinementReach(const GridSpec& grid);

/// Traces single rays from one position and chooses and weighs the REMs for what they meet (Meyer &
/// Loscos 2003, sections 4.1 to 4.3; Weighting); refineHits: see MemSettings. Const and free of
/// allocation, so that threads may share one.
class MemVertexTracer {
public:
    MemVertexTracer(const ReconstructionInput& input, const RemCandidates& candidates,
                    const glm::dvec3& position, bool refineHits);

    /// direction: scaled to 1 along its face's axis, so that the ray's parameter is the depth z.
    [[nodiscard]] MemVertex trace(const glm::dvec3& direction) const;
    /// The same for a ray that was traced already: its parameter where it hit, +infinity for sky.
    [[nodiscard]] MemVertex at(const glm::dvec3& direction, double t) const;

    [[nodiscard]] const HeightfieldTracer& heightfield() const { return m_tracer; }
    [[nodiscard]] const glm::dvec3& position() const { return m_position; }

    /// Whether a candidate is valid for the vertex, which remembers it.
    bool sees(std::int8_t candidate, MemVertex& vertex) const;
    [[nodiscard]] Weighting weighting() const { return m_weighting; }
    /// P − C of a candidate.
    [[nodiscard]] glm::dvec3 offset(std::int8_t candidate) const {
        return m_position - m_candidates[std::size_t(candidate)].rem->center;
    }

private:
    struct Candidate {
        const ReferenceEnvironmentMap* rem = nullptr;
        double presence = 1.0;
        double skyPenalty = 0.0;
    };

    void weigh(MemVertex& vertex) const;
    void weighBySight(MemVertex& vertex) const;
    void weighAsInPaper(MemVertex& vertex) const;
    void fallBack(MemVertex& vertex) const;
    void refine(MemVertex& vertex) const;

    const HeightfieldTracer& m_tracer;
    Weighting m_weighting;
    std::array<Candidate, kMostCandidates> m_candidates;
    std::size_t m_count = 0;
    glm::dvec3 m_position;
    double m_sceneDiameter;
    double m_reach;  ///< metres by which hits may move onto the REMs' surfaces; 0 = not at all
    double m_tolerance;
    double m_blendOfSky = 0.0;  ///< s of P, which the sky uses in the paper
};

}  // namespace reflet
