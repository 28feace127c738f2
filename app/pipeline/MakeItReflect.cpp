// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/MakeItReflect.h"

#include "app/pipeline/Edit.h"
#include "app/pipeline/Render.h"
#include "app/pipeline/Traffic.h"
#include "core/geo/SunPosition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace reflet {

namespace {

constexpr double kShortestRoute = 20.0;  // metres
constexpr double kCornerRadius = 12.0;   // metres
constexpr double kUneven = 0.15;         // metres that a route may float or sink
constexpr double kShortestStep = 4.0;    // metres between points that follow the ground
constexpr double kSampleStep = 2.0;      // metres between tests for buildings
constexpr double kMostlyInside = 0.5;    // share of a route in buildings that makes no sense
constexpr double kNoticed = 0.02;        // share that is worth a remark

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

/// Probes along the route, each moved out of what it would stand in.
std::size_t putProbes(Project& project, const RouteSpec& route, const PreparedCity& city,
                      const RadianceScene& scene, const ReflectOptions& options,
                      ReflectResult& result) {
    std::erase_if(project.probes, [&](const Probe& p) { return isAutomatic(p, route.id); });
    if (project.probes.empty())
        project.bake.resolution = options.resolution;
    const double length = routeInFrame(route, project.frame).length();
    const double fewest = double(std::max<std::size_t>(options.mostProbes, 2) - 1);
    const double spacing = std::max(options.spacing, length / fewest);
    std::set<std::string> taken;
    for (const auto& probe : project.probes)
        taken.insert(probe.id);
    std::size_t number = 0;
    std::size_t placed = 0;
    for (const glm::dvec3& place : probePlaces({&route}, spacing, project.frame)) {
        const auto free = nearestFreePosition(scene, &city.heightfield(), city.inFrame(place));
        if (!free) {
            result.remarks.push_back({Severity::Warning, "probe-left-out", route.id,
                                      "A probe was left out where the route runs through walls.",
                                      "Move the route into the street."});
            continue;
        }
        std::string id;
        do
            id = fmt::format("{}{:02}", automaticPrefix(route.id), ++number);
        while (!taken.insert(id).second);
        project.probes.push_back({id, *free + project.frame.origin, std::nullopt, false});
        ++placed;
    }
    return placed;
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
    result.probes = putProbes(project, route, city, **scene, options, result);
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    if (auto done = putView(project, city, result.reflector); !done)
        return tl::unexpected(done.error());
    return result;
}

}  // namespace reflet
