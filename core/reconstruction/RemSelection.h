// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/RemSet.h"
#include "core/reconstruction/MemSettings.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace reflet {

/// The two REMs that serve a position in the paper: A the nearest to P; B the nearest with
/// (C_A − P)·(C_B − P) < 0, else the second nearest. Ties by id. Indices into the set.
struct RemChoice {
    std::optional<std::size_t> a;
    std::optional<std::size_t> b;
};
[[nodiscard]] RemChoice chooseRems(const RemSet& rems, const glm::dvec3& position);

/// A REM that may serve the map around a position.
struct RemCandidate {
    std::size_t rem = 0;  ///< index into the set
    /// (0, 1]: fades to nothing before the REM leaves the candidates, so that nothing jumps then.
    double presence = 1.0;

    friend bool operator==(const RemCandidate&, const RemCandidate&) = default;
};

/// The REMs that a local map is made from, at most kMostCandidates of them: where some fade and
/// others come, there may be more than MemSettings::remsPerVehicle.
struct RemCandidates {
    Weighting weighting = Weighting::BySight;
    std::vector<RemCandidate> rems;
};
inline constexpr std::size_t kMostCandidates = 16;

/// Leaves kMostCandidates of candidates that stand in the order of their presence. What the first
/// one left out has is taken from all, so that this too is continuous.
void keepMostPresent(RemCandidates& candidates);

/// Indices of the nearest REMs, at most `most`, by distance then id.
[[nodiscard]] std::vector<std::size_t> nearestRems(const RemSet& rems, const glm::dvec3& position,
                                                   std::size_t most);

/// For Weighting::BySight the nearest ones, by distance then id; the presence of one falls linearly
/// to 0 over the last quarter of the way to where the first REM stands that is not among them. For
/// Weighting::AsInPaper A and B of chooseRems.
[[nodiscard]] RemCandidates candidateRems(const RemSet& rems, const glm::dvec3& position,
                                          const MemSettings& settings);

/// Blend parameter of a point between two centres: clamp(((I − C_A)·(C_B − C_A)) / |C_B − C_A|²),
/// 0 when the centres coincide. W_A = 1 − s, W_B = s.
[[nodiscard]] double blendParameter(const glm::dvec3& centerA, const glm::dvec3& centerB,
                                    const glm::dvec3& point);

/// The REM sees the point: the largest of the four distance texels around the direction is at
/// least |I − C| − epsilon. For sky (point empty): the largest is +infinity along `direction`.
[[nodiscard]] bool isValid(const ReferenceEnvironmentMap& rem, const glm::dvec3& point,
                           double epsilon);
[[nodiscard]] bool isValidSky(const ReferenceEnvironmentMap& rem, const glm::dvec3& direction);

/// How far a REM sees in a direction: the largest of the four distance texels around it.
[[nodiscard]] double seenDistance(const ReferenceEnvironmentMap& rem, const glm::dvec3& direction);

/// How unlike the vehicle's view of a point a REM's is (>= 0, 0 for C = P): the angle at I between
/// P and C, as a chord, and a part of what C stands farther away. After Buehler, Bosse, McMillan,
/// Gortler, Cohen 2001 (Unstructured Lumigraph Rendering), section 4: the error of a look-up by an
/// inexact I grows with the first, the blur of coarse texels with the second.
[[nodiscard]] double sightPenalty(const glm::dvec3& position, const glm::dvec3& center,
                                  const glm::dvec3& point);

}  // namespace reflet
