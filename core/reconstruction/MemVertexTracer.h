// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/Reconstruction.h"

namespace reflet {

/// Half a cell's diagonal, seen from above: how much nearer than I the surface in a REM's distance
/// map may lie before the REM counts as blind for I. The heightfield knows no better where I is.
[[nodiscard]] double validityTolerance(const GridSpec& grid);

/// Traces single rays from one position and weighs the two REMs for what they meet (Meyer & Loscos
/// 2003, sections 4.1 to 4.3); refineHits: see MemSettings. Const and free of allocation, so that
/// threads may share one.
class MemVertexTracer {
public:
    MemVertexTracer(const ReconstructionInput& input, const RemChoice& choice,
                    const glm::dvec3& position, bool refineHits);

    /// direction: scaled to 1 along its face's axis, so that the ray's parameter is the depth z.
    [[nodiscard]] MemVertex trace(const glm::dvec3& direction) const;

private:
    void weigh(MemVertex& vertex) const;
    void refine(MemVertex& vertex) const;
    [[nodiscard]] bool sees(const ReferenceEnvironmentMap* rem, const MemVertex& vertex) const;

    const HeightfieldTracer& m_tracer;
    const ReferenceEnvironmentMap* m_a;
    const ReferenceEnvironmentMap* m_b;
    glm::dvec3 m_position;
    double m_sceneDiameter;
    double m_reach;  ///< metres by which hits may move onto the REMs' surfaces; 0 = not at all
    double m_tolerance;
    double m_blendOfSky;  ///< s of P, which the sky uses
};

}  // namespace reflet
