// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/RemVerdicts.h"

#include "core/reconstruction/MemVertexTracer.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr std::size_t kNearest = 5;  // REMs that are told of beside the candidates
constexpr double kSteeper = 0.03;    // radians by which an angle must be larger to be the reason

double angleAt(const glm::dvec3& point, const glm::dvec3& one, const glm::dvec3& other) {
    const glm::dvec3 a = one - point, b = other - point;
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0.0 ? std::acos(std::clamp(glm::dot(a, b) / lengths, -1.0, 1.0)) : 0.0;
}

}  // namespace

DirectionVerdict explainDirection(const ReconstructionInput& input, const glm::dvec3& position,
                                  const glm::dvec3& direction, const MemSettings& settings) {
    const RemCandidates candidates = input.candidates(position, settings);
    const MemVertexTracer tracer(input, candidates, position, settings.refineHits);
    const glm::dvec3 size = glm::abs(direction);
    const MemVertex vertex = tracer.trace(direction / std::max({size.x, size.y, size.z}));

    DirectionVerdict out;
    out.sky = vertex.sky;
    out.point = vertex.point;
    out.uncovered = vertex.uncovered;
    std::vector<std::size_t> told;
    for (const RemCandidate& candidate : candidates.rems)
        told.push_back(candidate.rem);
    for (const std::size_t rem : nearestRems(input.rems, position, kNearest)) {
        if (std::find(told.begin(), told.end(), rem) == told.end())
            told.push_back(rem);
    }
    const double tolerance = validityTolerance(input.tracer->grid());
    for (std::size_t i = 0; i < told.size(); ++i) {
        const ReferenceEnvironmentMap& rem = input.rems[told[i]];
        RemVerdict verdict;
        verdict.rem = told[i];
        verdict.distance = glm::distance(rem.center, position);
        verdict.angle = vertex.sky ? 0.0 : angleAt(vertex.point, position, rem.center);
        if (i < candidates.rems.size()) {
            verdict.weight = (int(i) == vertex.a ? vertex.weightA : 0.0) +
                             (int(i) == vertex.b ? vertex.weightB : 0.0);
        }
        const bool sees =
            vertex.sky ? isValidSky(rem, vertex.direction) : isValid(rem, vertex.point, tolerance);
        verdict.reason = verdict.weight > 0.0 ? RemVerdict::Reason::Shown
                         : sees               ? RemVerdict::Reason::Farther
                                              : RemVerdict::Reason::Hidden;
        out.rems.push_back(verdict);
    }
    std::stable_sort(out.rems.begin(), out.rems.end(), [](const auto& x, const auto& y) {
        return x.weight != y.weight ? x.weight > y.weight : x.distance < y.distance;
    });
    for (RemVerdict& verdict : out.rems) {
        if (verdict.reason == RemVerdict::Reason::Farther &&
            verdict.angle > out.rems.front().angle + kSteeper)
            verdict.reason = RemVerdict::Reason::Angle;
    }
    return out;
}

}  // namespace reflet
