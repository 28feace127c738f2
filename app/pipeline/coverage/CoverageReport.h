// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoveragePlan.h"
#include "core/coverage/CoverageFigures.h"

#include <string>
#include <vector>

namespace reflet {

struct RouteCoverage {
    std::string id, name;
    std::map<std::string, std::string> attributes;  ///< of the line that it was read from
    LineFigures figures;
};

/// A stretch of a route where the vehicles' reflections are served worst.
struct WorstPlace {
    std::string route, name;
    double from = 0.0, to = 0.0;  ///< metres along the route
    glm::dvec3 position{0.0};     ///< absolute, on the running surface, the middle of the stretch
    double coverage = 0.0;
};

/// An object of the city that vehicles reflect, and how much of it no probe serves.
struct ObjectCoverage {
    std::string object;        ///< its id in the city model
    std::string type;          ///< as CityJSON calls it
    double reflected = 0.0;    ///< m² of walls that vehicles reflect
    double uncovered = 0.0;    ///< m² of them that are served less than kUncoveredBelow
    glm::dvec3 position{0.0};  ///< absolute, the middle of what is uncovered
};
/// A surface that is served less than this shows somewhere else's colours.
inline constexpr double kUncoveredBelow = 0.1;

struct ProbeCoverage {
    std::string id;
    double serves = 0.0;  ///< share of all that is asked for which it serves best
    double loss = 0.0;    ///< coverage that would be lost without it
};

/// How good the probes of a project are. Shares are 0..1.
struct CoverageReport {
    CoveragePlan plan;
    Demand demand;
    SampleCoverage samples;
    Estimate coverage;    ///< of the best service
    Estimate seen;        ///< share that at least one probe sees
    Estimate seenTwice;   ///< at least two
    Estimate shown;       ///< what the reconstruction makes of it (coverageAtRunTime)
    LineFigures figures;  ///< of all routes; empty for ground
    std::vector<RouteCoverage> routes;
    std::vector<CoveredStretch> stretches;  ///< of all routes, kStretch metres each
    std::vector<WorstPlace> worst;          ///< kWorstPlaces at most, the worst first
    std::vector<SurfacePatch> patches;      ///< kPatch metres, project frame
    std::vector<ObjectCoverage> objects;    ///< with something uncovered, the most first
    double reflectedWalls = 0.0;            ///< m²
    double uncoveredWalls = 0.0;            ///< m²
    std::vector<ProbeCoverage> probes;      ///< in the order of the project
    double seconds = 0.0;

    static constexpr double kStretch = 10.0;
    static constexpr double kPatch = 2.0;
    static constexpr std::size_t kWorstPlaces = 5;
    static constexpr double kWorstApart = 40.0;  ///< metres between worst places
};

[[nodiscard]] Result<CoverageReport> reportCoverage(const PreparedCity& city,
                                                    const CoverageOptions& options,
                                                    const JobContext& job);

}  // namespace reflet
