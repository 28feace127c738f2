// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/coverage/Service.h"
#include "core/reconstruction/MemSettings.h"
#include "core/reconstruction/PreparedRems.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// How each sample of a demand is served by a set of REMs.
struct SampleCoverage {
    std::vector<float> best;            ///< service of the best REM, 0..1
    std::vector<std::uint32_t> rem;     ///< index of that one, or kNoRem
    std::vector<unsigned char> seenBy;  ///< REMs within reach that see it at all; 255: or more

    static constexpr std::uint32_t kNoRem = 0xffffffffU;
};

/// rems: their centres and distances count (baked ones, or sightFrom()). In parallel.
[[nodiscard]] SampleCoverage coverageOf(const Demand& demand, const ServiceRule& rule,
                                        const RemSet& rems);

/// The service of what the reconstruction shows: for each sample, that of the REMs which the rule
/// of the run-time chooses, by their weights (MemVertexTracer); 0 where it is uncovered. At most
/// the best service of its set. In parallel.
[[nodiscard]] std::vector<float> coverageAtRunTime(const Demand& demand, const ServiceRule& rule,
                                                   const HeightfieldTracer& tracer,
                                                   const PreparedRems& rems,
                                                   const MemSettings& settings);

/// A stretch of a line.
struct CoveredStretch {
    std::uint32_t line = 0;
    double from = 0.0, to = 0.0;  ///< metres along the line
    std::size_t samples = 0;
    double coverage = 0.0;  ///< mean of the best service
    double seen = 0.0;      ///< share that at least one REM sees
    double seenTwice = 0.0;
};
/// The lines in stretches of at most `length` metres, in their order.
[[nodiscard]] std::vector<CoveredStretch> coveredStretches(const Demand& demand,
                                                           const SampleCoverage& coverage,
                                                           const std::vector<DemandLine>& lines,
                                                           double length);

/// What a planner asks of a line (or of all).
struct LineFigures {
    double length = 0.0;    ///< metres
    double coverage = 0.0;  ///< by length
    double seen = 0.0, seenTwice = 0.0;
    double worst = 0.0;         ///< the least of a stretch
    double worstStation = 0.0;  ///< its middle, metres along its line
    std::uint32_t worstLine = 0;
    double p05 = 0.0;         ///< a twentieth of the length is covered less
    double largestGap = 0.0;  ///< metres in a row that are covered less than kGapBelow
};
inline constexpr double kGapBelow = 0.5;
/// stretches: of one line, or of several one after the other; those without samples are left out.
[[nodiscard]] LineFigures lineFigures(const std::vector<CoveredStretch>& stretches);

/// The worst stretches, at most `most`, none within `apart` metres (in the plan, between middles)
/// of a worse one.
[[nodiscard]] std::vector<CoveredStretch> worstStretches(
    const std::vector<CoveredStretch>& stretches, const std::vector<DemandLine>& lines,
    std::size_t most, double apart);

/// A piece of the city's surface, as it is reflected: what lies in a cube of a lattice.
struct SurfacePatch {
    glm::dvec3 middle{0.0};  ///< mean of the points that were met
    glm::vec3 normal{0.0F};  ///< unit
    /// m²: what a plane of that normal has in a cube that it touches, on average (the number of
    /// cubes that a plane touches is known in closed form): s² / (|nx| + |ny| + |nz|).
    double area = 0.0;
    std::size_t samples = 0;
    double coverage = 0.0;  ///< mean of the best service
    bool wall = false;      ///< steeper than 45 degrees
};
/// All that is reflected, by cubes of `size` metres, in the order of the lattice.
[[nodiscard]] std::vector<SurfacePatch> surfacePatches(const Demand& demand,
                                                       const SampleCoverage& coverage, double size);

}  // namespace reflet
