// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "app/pipeline/TraceBench.h"

namespace reflet {

/// What `bench trace` traces in.
struct TraceBenchCity {
    std::string name;
    CityModel model;
    std::shared_ptr<const HeightfieldTracer> tracer;
    Heightfield field;
    std::vector<glm::dvec3> positions;  ///< of vehicles' local maps, in the project frame
    double diameter = 1000.0;           ///< metres
    MemSettings tuning;
};

/// The cities of the options, in order. Errors as benchTrace().
[[nodiscard]] Result<std::vector<TraceBenchCity>> traceBenchCities(const TraceBenchOptions& options,
                                                                   const JobContext& job);

/// The same surfaces in ten times the triangles: each is cut in four at the middles of its edges,
/// and two of the four again.
[[nodiscard]] CityModel tenfold(const CityModel& city);

}  // namespace reflet
