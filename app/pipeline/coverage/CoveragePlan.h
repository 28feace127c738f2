// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/coverage/Demand.h"
#include "core/coverage/Service.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// Where vehicles may be.
enum class DemandOn {
    Routes,  ///< on the routes that vehicles drive; on all routes where there is no vehicle
    Ground,  ///< anywhere on drivable ground
};

struct CoverageOptions {
    /// nullopt: on the routes, and on the ground in a project without routes.
    std::optional<DemandOn> on = std::nullopt;
    /// For routes without a vehicle, and for the ground; "" = "tram" on routes, "car" elsewhere.
    std::string vehicle;
    std::uint64_t seed = 0;
    double error = 0.005;  ///< half-width of the 95 % interval that the coverage is told with
    std::size_t mostSamples = std::size_t{1} << 20U;
};

/// What the coverage of a project is about.
struct CoveragePlan {
    std::vector<DemandLine> lines;       ///< ids are those of the routes; project frame
    std::vector<std::string> names;      ///< of the routes, as people call them
    std::optional<DemandGround> ground;  ///< in place of lines
    Onlookers onlookers;                 ///< the cameras of the project's views

    [[nodiscard]] Demand sample(const HeightfieldTracer& tracer, std::size_t count,
                                std::uint64_t seed) const {
        return ground ? sampleDemand(tracer, *ground, onlookers, count, seed)
                      : sampleDemand(tracer, lines, onlookers, count, seed);
    }
};

/// Usage when there is nothing to drive on, with what to do about it; what is wrong with a vehicle.
[[nodiscard]] Result<CoveragePlan> coveragePlan(const PreparedCity& city,
                                                const CoverageOptions& options);

/// What the probes of a project would see, by rays through the heightfield: maps without radiance,
/// in the order of the probes. In parallel. Cancelled.
[[nodiscard]] Result<RemSet> probeSights(const PreparedCity& city, const std::vector<Probe>& probes,
                                         const JobContext& job);

/// Samples until the mean of what `valuesOf` gives for them (one value a sample) is known to the
/// error that is asked for, or there are as many as are allowed. It is called last for the samples
/// that come back.
[[nodiscard]] Demand sampleToError(
    const CoveragePlan& plan, const HeightfieldTracer& tracer, const CoverageOptions& options,
    const std::function<std::vector<float>(const Demand&)>& valuesOf);

}  // namespace reflet
