// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/base/Diagnostic.h"

#include <string>
#include <vector>

namespace reflet {

struct ReflectOptions {
    std::string vehicle = "tram";  ///< built-in or of the project; put on a route that has none
    double coverage =
        0.95;  ///< of what the vehicle mirrors: probes are placed until it is reached,
    double leastGain = 0.002;     ///< or until the next one adds less,
    std::size_t mostProbes = 60;  ///< or there are so many
    int resolution = 128;         ///< of the maps, in a project that has no probes yet
};

struct ReflectResult {
    Project project;
    std::string route, reflector;
    std::size_t probes = 0;
    std::vector<Diagnostic> remarks;  ///< e.g. the share of the route that runs through buildings
};

/// All that makes a vehicle on a route reflect the city (DESIGN 8, "three clicks"): the route
/// draped on the ground, a vehicle, probes where they serve it most, at body-centre height and
/// outside of solids (suggestProbes), a view from the pavement with the sun behind. The project is
/// the city's with the changes; nothing is written. What an earlier call made for the route of this
/// id is replaced, but for locked probes and vehicles. An empty id gets a new one.
///
/// Usage for a route shorter than 20 m; Refused when it leaves the city or runs through buildings
/// for the most part.
[[nodiscard]] Result<ReflectResult> makeItReflect(const PreparedCity& city, RouteSpec route,
                                                  const ReflectOptions& options,
                                                  const JobContext& job);

/// Heights for the points (absolute) from the ground below them: all of them, or those that have
/// none (NaN). With `all`, points are added where the ground is not straight between two.
enum class Drape { Missing, All };
void drapeOnGround(std::vector<glm::dvec3>& points, const PreparedCity& city, Drape which);

/// Places (absolute) at body-centre height at most `step` metres apart along routes; where two
/// routes share a street, once.
[[nodiscard]] std::vector<glm::dvec3> probePlaces(const std::vector<const RouteSpec*>& routes,
                                                  double step, const ProjectFrame& frame);

}  // namespace reflet
