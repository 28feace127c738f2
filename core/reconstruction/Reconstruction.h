// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/HeightfieldTracer.h"
#include "core/reconstruction/MemSettings.h"
#include "core/reconstruction/PreparedRems.h"
#include "core/reconstruction/RemSelection.h"
#include "core/reconstruction/TexelSources.h"

#include <array>
#include <cstdint>
#include <vector>

namespace reflet {

/// One vertex of the adaptive mesh after tracing (DESIGN 5.3).
struct MemVertex {
    glm::dvec3 direction{0.0};  ///< scaled to 1 along the face's axis
    bool sky = false;
    double inverseDepth = 0.0;  ///< 1/z, z the depth of I along the face's axis; 0 for sky
    double distance = 0.0;      ///< |I − P|; the scene's diameter for sky
    glm::dvec3 point{0.0};      ///< I; meaningless for sky
    /// The REMs that show it, A before B: indices into RemCandidates::rems; -1 = none.
    std::int8_t a = -1;
    std::int8_t b = -1;
    bool validA = false;
    bool validB = false;
    bool uncovered = false;    ///< no candidate is valid
    std::uint16_t tested = 0;  ///< bit i: candidate i was tested for validity
    std::uint16_t seenBy = 0;  ///< bit i: candidate i was tested and is valid
    double weightA = 1.0;      ///< after the validity test, weightA + weightB = 1
    double weightB = 0.0;
};

/// A leaf of the mesh: an axis-aligned rectangle of face space, half-open towards larger s and t,
/// corners in order (s0,t0) (s1,t0) (s0,t1) (s1,t1), as indices into MemFace::vertices. The leaves
/// of a face partition [-1, 1]². Four times the same vertex: the leaf holds the centre of a single
/// texel, and the vertex is that texel's (MemSettings::traceEdgeTexels).
struct MemQuad {
    double s0 = 0, t0 = 0, s1 = 0, t1 = 0;  ///< in [-1, 1]
    std::array<std::uint32_t, 4> vertex{};
};

struct MemFace {
    std::vector<MemVertex> vertices;
    std::vector<MemQuad> quads;
};

/// Everything that a reconstruction reads; all must outlive it.
struct ReconstructionInput {
    const HeightfieldTracer* tracer = nullptr;
    RemSet rems;
    double sceneDiameter = 1000.0;           ///< metres, the distance that sky counts as
    const PreparedRems* prepared = nullptr;  ///< of these REMs; null: those nearest by distance

    /// The REMs for a map around a position.
    [[nodiscard]] RemCandidates candidates(const glm::dvec3& position,
                                           const MemSettings& settings) const {
        return prepared ? prepared->at(position, settings)
                        : candidateRems(rems, position, settings);
    }
};

/// The adaptive mesh of one face, before any texel is written: what the GPU path draws, and what
/// the paper's figure 7 shows.
[[nodiscard]] MemFace buildMemFace(const ReconstructionInput& input,
                                   const RemCandidates& candidates, const glm::dvec3& position,
                                   int face, const MemSettings& settings);

/// The meshes of all six faces, in parallel; faster than one after the other.
[[nodiscard]] std::vector<MemFace> buildMemFaces(const ReconstructionInput& input,
                                                 const RemCandidates& candidates,
                                                 const glm::dvec3& position,
                                                 const MemSettings& settings);

/// The paper's method, complete (Meyer & Loscos 2003, section 4; DESIGN 5.3). Each texel's centre
/// belongs to exactly one leaf of the mesh, from which 1/z and the weights are interpolated. No REM
/// at all: radiance zero and everything uncovered. In parallel; the same bits for any number of
/// threads. The position may lie anywhere, also outside the grid. sources: where each texel's
/// radiance was looked up, for who wants to know.
[[nodiscard]] LocalEnvironmentMap reconstructMem(const ReconstructionInput& input,
                                                 const glm::dvec3& position,
                                                 const MemSettings& settings,
                                                 TexelSources* sources = nullptr);

/// Without a mesh: a ray through the centre of each texel, and the REMs that serve what it meets.
/// Of the settings the resolution, refineHits and those of the REMs count. Statistics: a vertex is
/// a texel, and there are no quads.
[[nodiscard]] LocalEnvironmentMap reconstructDense(const ReconstructionInput& input,
                                                   const glm::dvec3& position,
                                                   const MemSettings& settings,
                                                   TexelSources* sources = nullptr);

/// Baselines: the nearest REM looked up as if at infinity, and the two REMs blended at infinity
/// with the weights of P. No rays; distances are those of the nearest REM from its own centre.
/// No REM at all: black, at infinity, everything uncovered.
[[nodiscard]] LocalEnvironmentMap reconstructNearest(const ReconstructionInput& input,
                                                     const glm::dvec3& position, int resolution,
                                                     TexelSources* sources = nullptr);
[[nodiscard]] LocalEnvironmentMap reconstructBlend(const ReconstructionInput& input,
                                                   const glm::dvec3& position, int resolution,
                                                   TexelSources* sources = nullptr);

}  // namespace reflet
