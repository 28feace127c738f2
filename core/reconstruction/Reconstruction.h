// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/environment/RemSet.h"
#include "core/heightfield/HeightfieldTracer.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// How texture coordinates run between the vertices of a quad (DESIGN 5.3).
enum class Interpolation {
    Exact,      ///< q = d′ + (P − C)/z, exact on planes
    AsInPaper,  ///< the vectors C→I linearly, as the 2003 hardware did
};

/// Settings of the multiple-environment-map reconstruction; defaults are the paper's but for what
/// is marked as ours.
struct MemSettings {
    /// N: quads along an edge of a face before subdivision; between 1 and the resolution.
    int meshSize = 10;
    /// R: a quad is split when the distances of two of its corners differ by more than R times the
    /// smaller. Infinity never splits (the plain mesh), 0 always does (the full mesh).
    double depthRatio = 0.2;
    double smallestQuad = 1.0;  ///< texels; no child is smaller; 1 = one texel
    /// Ours: split also where validity or REM choice differs, or where surface meets sky.
    bool refineAtValidity = true;
    /// Ours: where one texel is the limit (smallestQuad <= 1) and a smallest quad still wants to be
    /// split, its texels get a ray each, through their centres. Without it a quad that lies across
    /// a silhouette mixes two surfaces.
    bool traceEdgeTexels = true;
    /// Ours: a hit of the heightfield that a REM sees is moved along its ray onto the plane that
    /// the REM's distances show there, by four cells at most: heightfields know oblique walls and
    /// roofs only as stairs. Off, all errors but those of the heightfield remain (DESIGN 5.8).
    bool refineHits = true;
    Interpolation interpolation = Interpolation::Exact;
    int resolution = 128;  ///< of the local map

    friend bool operator==(const MemSettings&, const MemSettings&) = default;
};

/// The two REMs that serve a position: A the nearest to P; B the nearest with
/// (C_A − P)·(C_B − P) < 0, else the second nearest. Ties by id. Indices into the span.
struct RemChoice {
    std::optional<std::size_t> a;
    std::optional<std::size_t> b;
};
[[nodiscard]] RemChoice chooseRems(const RemSet& rems, const glm::dvec3& position);

/// Blend parameter of a point between two centres: clamp(((I − C_A)·(C_B − C_A)) / |C_B − C_A|²),
/// 0 when the centres coincide. W_A = 1 − s, W_B = s.
[[nodiscard]] double blendParameter(const glm::dvec3& centerA, const glm::dvec3& centerB,
                                    const glm::dvec3& point);

/// The REM sees the point: the largest of the four distance texels around the direction is at
/// least |I − C| − epsilon. For sky (point empty): the largest is +infinity along `direction`.
[[nodiscard]] bool isValid(const ReferenceEnvironmentMap& rem, const glm::dvec3& point,
                           double epsilon);
[[nodiscard]] bool isValidSky(const ReferenceEnvironmentMap& rem, const glm::dvec3& direction);

/// One vertex of the adaptive mesh after tracing (DESIGN 5.3).
struct MemVertex {
    glm::dvec3 direction{0.0};  ///< scaled to 1 along the face's axis
    bool sky = false;
    double inverseDepth = 0.0;  ///< 1/z, z the depth of I along the face's axis; 0 for sky
    double distance = 0.0;      ///< |I − P|; the scene's diameter for sky
    glm::dvec3 point{0.0};      ///< I; meaningless for sky
    double weightA = 1.0;       ///< after the validity test, weightA + weightB = 1
    double weightB = 0.0;
    bool validA = false;
    bool validB = false;
    bool uncovered = false;  ///< neither is valid
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
    double sceneDiameter = 1000.0;  ///< metres, the distance that sky counts as
};

/// The adaptive mesh of one face, before any texel is written: what the GPU path draws, and what
/// the paper's figure 7 shows.
[[nodiscard]] MemFace buildMemFace(const ReconstructionInput& input, const RemChoice& choice,
                                   const glm::dvec3& position, int face,
                                   const MemSettings& settings);

/// The paper's method, complete (Meyer & Loscos 2003, section 4; DESIGN 5.3). Each texel's centre
/// belongs to exactly one leaf of the mesh, from which 1/z and the weights are interpolated. No REM
/// at all: radiance zero and everything uncovered. In parallel; the same bits for any number of
/// threads. The position may lie anywhere, also outside the grid.
[[nodiscard]] LocalEnvironmentMap reconstructMem(const ReconstructionInput& input,
                                                 const glm::dvec3& position,
                                                 const MemSettings& settings);

/// Baselines: the nearest REM looked up as if at infinity, and the two REMs blended at infinity
/// with the weights of P. No rays; distances are those of the nearest REM from its own centre.
/// No REM at all: black, at infinity, everything uncovered.
[[nodiscard]] LocalEnvironmentMap reconstructNearest(const ReconstructionInput& input,
                                                     const glm::dvec3& position, int resolution);
[[nodiscard]] LocalEnvironmentMap reconstructBlend(const ReconstructionInput& input,
                                                   const glm::dvec3& position, int resolution);

}  // namespace reflet
