// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/MakeItReflect.h"

#include "app/pipeline/Edit.h"
#include "app/pipeline/Render.h"
#include "app/pipeline/Traffic.h"
#include "app/pipeline/coverage/Suggest.h"
#include "core/geo/SunPosition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace reflet {

namespace {

constexpr double kShortestRoute = 20.0;       // metres
constexpr double kCornerRadius = 12.0;        // metres
constexpr double kUneven = 0.15;              // metres that a route may float or sink
constexpr double kShortestStep = 4.0;         // metres between points that follow the ground
constexpr double kSampleStep = 2.0;           // metres between tests for buildings
constexpr double kMostlyInside = 0.5;         // share of a route in buildings that makes no sense
constexpr double kNoticed = 0.02;             // share that is worth a remark
constexpr double kRoughly = 0.02;             // error of the coverage that probes are placed by
constexpr double kCandidateSpacing = 5.0;     // metres between places for probes
constexpr std::size_t kMostCandidates = 300;  // of them along a route

/// Ids of what was made for a route by this function.
std::string automaticPrefix(const std::string& route) {
    return route + "-p";
}

bool isAutomatic(const Probe& probe, const std::string& route) {
    const std::string prefix = automaticPrefix(route);
    return !probe.locked && probe.id.size() > prefix.size() && probe.id.rfind(prefix, 0) == 0 &&
           std::all_of(probe.id.begin() + std::ptrdiff_t(prefix.size()), probe.id.end(),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
}

double lengthOf(const std::vector<glm::dvec3>& points) {
    double length = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i)
        length += glm::distance(glm::dvec2(points[i - 1]), glm::dvec2(points[i]));
    return length;
}

/// Metres along the route's points (in the plan) to what of them is nearest to a place.
double stationOf(const RouteSpec& route, const glm::dvec3& place) {
    double best = 0.0, along = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < route.points.size(); ++i) {
        const glm::dvec2 a(route.points[i - 1]), way(glm::dvec2(route.points[i]) - a);
        const double length = glm::length(way);
        const double share =
            length > 0.0
                ? std::clamp(glm::dot(glm::dvec2(place) - a, way) / (length * length), 0.0, 1.0)
                : 0.0;
        const double away = glm::distance(a + share * way, glm::dvec2(place));
        if (away < least) {
            least = away;
            best = along + share * length;
        }
        along += length;
    }
    return best;
}

Result<void> checkRoute(const PreparedCity& city, const RouteSpec& route) {
    const bool finite = std::all_of(route.points.begin(), route.points.end(), [](const auto& p) {
        return std::isfinite(p.x) && std::isfinite(p.y);
    });
    if (!finite || route.points.size() < 2 || lengthOf(route.points) < kShortestRoute) {
        return fail(ErrorCode::Usage,
                    fmt::format("the route is shorter than {:.0f} m", kShortestRoute), route.id,
                    "Put its end further away: a vehicle needs room to drive.");
    }
    const GridSpec& grid = city.heightfield().grid;
    for (const auto& point : route.points) {
        const glm::dvec3 local = city.inFrame(point);
        if (!grid.contains(grid.column(local.x), grid.row(local.y))) {
            return fail(ErrorCode::Refused, "the route leaves the city model", route.id,
                        "Keep all its points where there are buildings or ground.");
        }
    }
    return {};
}

/// The share of the route that runs inside solids, at the height of a vehicle's body.
double shareInside(const RadianceScene& scene, const Route& route) {
    const auto stations = route.stations(kSampleStep);
    std::size_t inside = 0;
    for (const double station : stations) {
        const glm::dvec3 place = route.at(station) + glm::dvec3(0.0, 0.0, kProbeHeight);
        inside += scene.insideSolid(glm::vec3(place)) ? 1 : 0;
    }
    return stations.empty() ? 0.0 : double(inside) / double(stations.size());
}

std::string freeRouteId(const Project& project) {
    for (int i = 1;; ++i) {
        std::string id = fmt::format("route{}", i);
        const auto taken = [&](const RouteSpec& route) { return route.id == id; };
        if (std::none_of(project.routes.begin(), project.routes.end(), taken))
            return id;
    }
}

void putRoute(Project& project, const RouteSpec& route) {
    const auto same = std::find_if(project.routes.begin(), project.routes.end(),
                                   [&](const RouteSpec& r) { return r.id == route.id; });
    if (same != project.routes.end()) {
        *same = route;
    } else {
        project.routes.push_back(route);
    }
}

/// The vehicle on the route; a new one when there is none.
std::string putReflector(Project& project, const std::string& vehicle, const std::string& route) {
    for (const auto& reflector : project.reflectors) {
        if (reflector.route == route)
            return reflector.id;
    }
    Reflector reflector;
    reflector.vehicle = vehicle;
    reflector.route = route;
    const auto taken = [&](const Reflector& r) { return r.id == reflector.id; };
    int number = 0;
    do
        reflector.id = fmt::format("{}{}", vehicle, ++number);
    while (std::any_of(project.reflectors.begin(), project.reflectors.end(), taken));
    project.reflectors.push_back(reflector);
    return reflector.id;
}

/// The city with this route alone and what drives there: what the probes are suggested for.
Result<PreparedCity> cityOfRoute(const PreparedCity& city, Project project,
                                 const std::string& route, const JobContext& job) {
    std::erase_if(project.routes, [&](const RouteSpec& r) { return r.id != route; });
    std::erase_if(project.reflectors, [&](const Reflector& r) { return r.route != route; });
    project.views.clear();  // seen from the pavement, wherever it drives
    return city.updated(std::move(project), city.folder() / "route.reflet", job);
}

/// Probes where they serve the route most, besides those that are there already.
Result<std::size_t> putProbes(Project& project, const RouteSpec& route, const PreparedCity& city,
                              const ReflectOptions& options, const JobContext& job) {
    std::erase_if(project.probes, [&](const Probe& p) { return isAutomatic(p, route.id); });
    if (project.probes.empty())
        project.bake.resolution = options.resolution;
    const auto alone = cityOfRoute(city, project, route.id, job.phase("preparing", 0.0, 0.1));
    if (!alone)
        return tl::unexpected(alone.error());
    SuggestOptions wish;
    wish.coverage = options.coverage;
    wish.leastGain = options.leastGain;
    wish.count = options.mostProbes;
    wish.vehicle = options.vehicle;
    wish.error = kRoughly;
    wish.baselines = false;
    wish.certificate = false;
    const double length = routeInFrame(route, project.frame).length();
    wish.spacing = std::max(kCandidateSpacing, length / double(kMostCandidates));
    const auto suggestion = suggestProbes(*alone, wish, job.phase("placing probes", 0.1, 1.0));
    if (!suggestion)
        return tl::unexpected(suggestion.error());
    std::set<std::string> taken;
    for (const auto& probe : project.probes)
        taken.insert(probe.id);
    std::vector<glm::dvec3> places;
    for (const SuggestedProbe& probe : suggestion->probes)
        places.push_back(probe.position);
    // Named in the order in which they stand along the route.
    const auto station = [&](const glm::dvec3& place) { return stationOf(route, place); };
    std::stable_sort(places.begin(), places.end(), [&](const glm::dvec3& x, const glm::dvec3& y) {
        return station(x) < station(y);
    });
    std::size_t number = 0;
    for (const glm::dvec3& place : places) {
        std::string id;
        do
            id = fmt::format("{}{:02}", automaticPrefix(route.id), ++number);
        while (!taken.insert(id).second);
        project.probes.push_back({id, place, std::nullopt, false});
    }
    return places.size();
}

Result<void> putView(Project& project, const PreparedCity& city, const std::string& reflector) {
    const auto traffic = trafficOf(project, city.folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    const auto index = traffic->find(reflector);
    if (!index)
        return tl::unexpected(index.error());
    View view = streetView(city, *traffic, *index);
    std::erase_if(project.views, [&](const View& v) { return v.name == view.name; });
    project.views.push_back(std::move(view));
    return {};
}

/// Adds points between two where the ground is higher or lower than the line between them.
void followGround(const PreparedCity& city, const glm::dvec3& from, const glm::dvec3& to,
                  std::vector<glm::dvec3>& out) {
    if (glm::distance(glm::dvec2(from), glm::dvec2(to)) < 2.0 * kShortestStep)
        return;
    glm::dvec3 middle = 0.5 * (from + to);
    const glm::dvec3 local = city.inFrame(middle);
    const double ground = city.groundHeight(local.x, local.y) + city.project().frame.origin.z;
    const double off = std::abs(ground - middle.z);
    middle.z = ground;
    std::vector<glm::dvec3> before, after;
    followGround(city, from, middle, before);
    followGround(city, middle, to, after);
    if (off < kUneven && before.empty() && after.empty())
        return;
    out.insert(out.end(), before.begin(), before.end());
    out.push_back(middle);
    out.insert(out.end(), after.begin(), after.end());
}

}  // namespace

void drapeOnGround(std::vector<glm::dvec3>& points, const PreparedCity& city, Drape which) {
    for (auto& point : points) {
        if (which == Drape::Missing && !std::isnan(point.z))
            continue;
        const glm::dvec3 local = city.inFrame(point);
        point.z = city.groundHeight(local.x, local.y) + city.project().frame.origin.z;
    }
    if (which == Drape::Missing)
        return;
    std::vector<glm::dvec3> draped;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0)
            followGround(city, points[i - 1], points[i], draped);
        draped.push_back(points[i]);
    }
    points = std::move(draped);
}

std::vector<glm::dvec3> probePlaces(const std::vector<const RouteSpec*>& routes, double step,
                                    const ProjectFrame& frame) {
    std::vector<glm::dvec3> places;
    for (const RouteSpec* spec : routes) {
        const Route route = routeInFrame(*spec, frame);
        for (const double s : route.stations(step)) {
            const glm::dvec3 place =
                route.at(s) + frame.origin + glm::dvec3(0.0, 0.0, kProbeHeight);
            const bool taken = std::any_of(
                places.begin(), places.end(),
                [&](const glm::dvec3& other) { return glm::distance(place, other) < 0.25 * step; });
            if (!taken)
                places.push_back(place);
        }
    }
    return places;
}

Result<ReflectResult> makeItReflect(const PreparedCity& city, RouteSpec route,
                                    const ReflectOptions& options, const JobContext& job) {
    ReflectResult result;
    result.project = city.project();
    Project& project = result.project;
    if (route.id.empty())
        route.id = freeRouteId(project);
    if (auto sound = checkRoute(city, route); !sound)
        return tl::unexpected(sound.error());
    drapeOnGround(route.points, city, Drape::All);
    if (!(route.cornerRadius > 0.0))
        route.cornerRadius = kCornerRadius;
    const auto scene = city.scene(job.phase("preparing", 0.0, 0.5));
    if (!scene)
        return tl::unexpected(scene.error());
    const double inside = shareInside(**scene, routeInFrame(route, project.frame));
    if (inside > kMostlyInside) {
        return fail(ErrorCode::Refused,
                    fmt::format("{:.0f} % of the route runs through buildings", 100.0 * inside),
                    route.id, "Draw it along a street.");
    }
    if (inside > kNoticed) {
        result.remarks.push_back(
            {Severity::Warning, "route-in-buildings", route.id,
             fmt::format("{:.0f} % of the route runs through buildings.", 100.0 * inside),
             "Move its points into the street."});
    }
    job.progress(0.6);
    putRoute(project, route);
    result.route = route.id;
    result.reflector = putReflector(project, options.vehicle, route.id);
    const auto probes =
        putProbes(project, route, city, options, job.phase("placing probes", 0.6, 0.95));
    if (!probes)
        return tl::unexpected(probes.error());
    result.probes = *probes;
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    if (auto done = putView(project, city, result.reflector); !done)
        return tl::unexpected(done.error());
    return result;
}

}  // namespace reflet
