// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Edit.h"

#include "app/pipeline/AxisOrder.h"
#include "app/pipeline/MakeItReflect.h"
#include "app/pipeline/Traffic.h"
#include "app/pipeline/VehicleFile.h"
#include "core/io/GeoFile.h"
#include "core/project/ProjectFile.h"
#include "core/traffic/UsualSpeed.h"
#include "importers/osm/OsmImporter.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace reflet {

namespace {

using nlohmann::json;

/// A name that is not taken yet: the wish itself, else with a number behind it.
template <class Taken>
std::string freeName(const std::string& wish, const Taken& taken) {
    if (!wish.empty() && !taken(wish))
        return wish;
    for (int i = 2;; ++i) {
        std::string name = fmt::format("{}-{}", wish.empty() ? "route" : wish, i);
        if (!taken(name))
            return name;
    }
}

bool hasProbe(const Project& project, const std::string& id) {
    return std::any_of(project.probes.begin(), project.probes.end(),
                       [&](const Probe& p) { return p.id == id; });
}

bool hasRoute(const Project& project, const std::string& id) {
    return std::any_of(project.routes.begin(), project.routes.end(),
                       [&](const RouteSpec& r) { return r.id == id; });
}

/// Sets a dotted key of the project's JSON; the key must exist in a project.
Result<Project> withSetting(const Project& project, const std::string& key,
                            const std::string& value) {
    const bool plain = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '.';
    });
    json root = json::parse(projectToJson(project));
    std::string pointer = "/" + key;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    const json::json_pointer place(plain ? pointer : "/");
    static const std::set<std::string> fixed{"schema",   "version",    "models",
                                             "probes",   "noProbes",   "routes",
                                             "vehicles", "reflectors", "views"};
    if (!root.contains(place) || root.at(place).is_object() ||
        fixed.count(key.substr(0, key.find('.'))) > 0) {
        return fail(ErrorCode::Usage, "a project has no setting of that name", key,
                    "Settings are e.g. tuning.depthRatio, bake.resolution, light.date, exposure; "
                    "see the manual.");
    }
    json parsed = json::parse(value, nullptr, false);
    root[place] = parsed.is_discarded() ? json(value) : parsed;
    return projectFromJson(root.dump(), "--set " + key + "=" + value);
}

Result<void> removeItem(Project& project, const std::string& id) {
    const auto drop = [&](auto& list, const auto& idOf) {
        return std::erase_if(list, [&](const auto& item) { return idOf(item) == id; });
    };
    std::size_t removed = drop(project.probes, [](const Probe& p) { return p.id; });
    removed += drop(project.noProbes, [](const NoProbeArea& a) { return a.id; });
    removed += drop(project.reflectors, [](const Reflector& r) { return r.id; });
    removed += drop(project.views, [](const View& v) { return v.name; });
    const bool driven = std::any_of(project.reflectors.begin(), project.reflectors.end(),
                                    [&](const Reflector& r) { return r.route == id; });
    if (driven && hasRoute(project, id)) {
        return fail(ErrorCode::Usage, "a vehicle drives this route", id,
                    "Remove the vehicle first.");
    }
    const bool shown = std::any_of(project.reflectors.begin(), project.reflectors.end(),
                                   [&](const Reflector& r) { return r.vehicle == id; });
    if (!shown)
        removed += drop(project.vehicles, [](const VehicleModel& v) { return v.id; });
    removed += drop(project.routes, [](const RouteSpec& r) { return r.id; });
    if (removed > 0)
        return {};
    return fail(ErrorCode::Usage, "the project has nothing of that name", id,
                "See the project file for its names.");
}

/// Adds or moves a probe.
void placeProbe(Project& project, const std::string& id, const glm::dvec3& absolute) {
    for (auto& probe : project.probes) {
        if (probe.id == id) {
            probe.position = absolute;
            return;
        }
    }
    project.probes.push_back({id, absolute, std::nullopt, false});
}

Result<void> setLocked(Project& project, const std::string& id, bool locked) {
    for (auto& probe : project.probes) {
        if (probe.id == id) {
            probe.locked = locked;
            return {};
        }
    }
    return fail(ErrorCode::Usage, "the project has no probe of that name", id,
                "See the project file for its probes.");
}

void putNoProbeArea(Project& project, const NoProbeArea& area) {
    for (auto& one : project.noProbes) {
        if (one.id == area.id) {
            one = area;
            return;
        }
    }
    project.noProbes.push_back(area);
}

/// Routes that vehicles drive; all routes when there is no vehicle.
std::vector<const RouteSpec*> drivenRoutes(const Project& project) {
    std::vector<const RouteSpec*> out;
    for (const auto& route : project.routes) {
        const bool driven = std::any_of(project.reflectors.begin(), project.reflectors.end(),
                                        [&](const Reflector& r) { return r.route == route.id; });
        if (driven || project.reflectors.empty())
            out.push_back(&route);
    }
    return out;
}

}  // namespace

Result<std::size_t> placeProbesEvery(Project& project, double step) {
    if (!(step >= 0.5 && step <= 10'000.0)) {
        return fail(ErrorCode::Usage, "the spacing of probes is out of range", "--probes-every",
                    "Take 0.5 to 10000 metres; 15 is a good start.");
    }
    const auto routes = drivenRoutes(project);
    if (routes.empty()) {
        return fail(ErrorCode::Usage, "there is no route to place probes along", "--probes-every",
                    "Add one with --route LINE.geojson.");
    }
    const std::vector<glm::dvec3> places = probePlaces(routes, step, project.frame);
    std::size_t number = 0;
    for (const auto& place : places) {
        std::string id;
        do
            id = fmt::format("p{:03}", ++number);
        while (hasProbe(project, id));
        project.probes.push_back({id, place, std::nullopt, false});
    }
    return places.size();
}

namespace {

Result<void> addVehicle(Project& project, const VehicleRequest& request,
                        const std::filesystem::path& projectFile, std::vector<Diagnostic>& remarks,
                        const JobContext& job) {
    if (!hasRoute(project, request.route)) {
        std::string known;
        for (const auto& route : project.routes)
            known += (known.empty() ? "" : ", ") + route.id;
        return fail(ErrorCode::Usage, "the project has no route of that name", request.route,
                    known.empty() ? "Add one with --route LINE.geojson."
                                  : "Its routes are: " + known + ".");
    }
    auto vehicle = adoptVehicle(project, request.vehicle, projectFile.parent_path(), remarks, job);
    if (!vehicle)
        return tl::unexpected(vehicle.error());
    std::erase_if(project.reflectors, [&](const Reflector& r) { return r.id == request.id; });
    Reflector reflector;
    reflector.id = request.id;
    reflector.vehicle = *vehicle;
    reflector.route = request.route;
    reflector.speed = usualSpeed(*vehicle);
    project.reflectors.push_back(reflector);
    return {};
}

Result<void> setInterest(Project& project, const std::string& id, double interest) {
    if (!(interest >= 0.0 && interest <= kMostInterest)) {
        return fail(ErrorCode::Usage, "the interest is out of range", "--interest " + id,
                    fmt::format("Take 0 to {}; 1 is usual.", kMostInterest));
    }
    for (Reflector& reflector : project.reflectors) {
        if (reflector.id == id) {
            reflector.interest = interest;
            return {};
        }
    }
    return fail(ErrorCode::Usage, "the project has no vehicle of that name", id,
                "Add one with --vehicle ID=tram,ROUTE, or see the project file for its names.");
}

Result<void> applyProbes(EditReport& report, const EditRequest& request,
                         const std::filesystem::path& projectFile, const JobContext& job) {
    const bool needsGround = std::any_of(request.probes.begin(), request.probes.end(),
                                         [](const ProbeRequest& probe) { return !probe.up; });
    std::optional<PreparedCity> city;
    if (needsGround) {
        auto prepared = PreparedCity::prepare(report.project, projectFile, job);
        if (!prepared)
            return tl::unexpected(prepared.error());
        city.emplace(std::move(*prepared));
    }
    for (const auto& probe : request.probes) {
        glm::dvec3 place(probe.east, probe.north, 0.0);
        const glm::dvec3 local = place - report.project.frame.origin;
        place.z = probe.up ? *probe.up
                           : city->groundHeight(local.x, local.y) + report.project.frame.origin.z +
                                 kProbeHeight;
        placeProbe(report.project, probe.id, place);
        ++report.probesAdded;
    }
    return {};
}

/// The lines that a file offers as routes. Of OpenStreetMap data, which have hundreds, the tram
/// lines, else the longest streets.
Result<std::vector<GeoLine>> readRoutes(const std::filesystem::path& path,
                                        const ProjectFrame& frame, std::vector<Diagnostic>& remarks,
                                        const JobContext& job) {
    if (!isOsmFile(path))
        return readLines(path, frame);
    constexpr std::size_t kTrams = 12, kStreets = 3;
    auto offered = readOsmRoutes(path, frame, job);
    if (!offered)
        return tl::unexpected(offered.error());
    const bool trams = offered->trams > 0;
    const std::size_t all = offered->lines.size();
    const std::size_t taken = trams ? std::min(kTrams, offered->trams) : std::min(kStreets, all);
    offered->lines.resize(taken);
    remarks.push_back(
        {Severity::Info, "routes-chosen", path.string(),
         fmt::format("the {} longest {} became routes, of {} tram lines and {} "
                     "streets",
                     taken, trams ? "tram lines" : "streets", offered->trams, all - offered->trams),
         "For others, save their lines to a GeoJSON file and name it with --route."});
    return std::move(offered->lines);
}

}  // namespace

Result<std::size_t> addRoutes(Project& project, const std::filesystem::path& projectFile,
                              const std::filesystem::path& lines, const std::string& vehicle,
                              std::vector<Diagnostic>& remarks, const JobContext& job) {
    std::string driven;
    if (!vehicle.empty()) {
        auto adopted = adoptVehicle(project, vehicle, projectFile.parent_path(), remarks, job);
        if (!adopted)
            return tl::unexpected(adopted.error());
        driven = std::move(*adopted);
    }
    auto read = readRoutes(lines, project.frame, remarks, job);
    if (!read)
        return tl::unexpected(read.error());
    if (read->empty()) {
        return fail(ErrorCode::Unreadable, "the file holds no line", lines.string(),
                    "Draw the route as a LineString, e.g. in QGIS.");
    }
    auto city = PreparedCity::prepare(project, projectFile, job);
    if (!city)
        return tl::unexpected(city.error());
    for (auto& line : *read) {
        drapeOnGround(line.points, *city, Drape::Missing);
        RouteSpec route;
        route.id =
            freeName(line.name, [&](const std::string& name) { return hasRoute(project, name); });
        route.name = line.name;
        route.attributes = std::move(line.attributes);
        route.cornerRadius = 12.0;
        route.points = std::move(line.points);
        project.routes.push_back(route);
        if (driven.empty())
            continue;
        if (auto added = addVehicle(project, {driven + "-" + route.id, driven, route.id},
                                    projectFile, remarks, job);
            !added) {
            return tl::unexpected(added.error());
        }
    }
    return read->size();
}

Result<EditReport> editProject(const std::filesystem::path& projectFile, const EditRequest& request,
                               const JobContext& job) {
    auto project = loadProject(projectFile);
    if (!project)
        return tl::unexpected(project.error());
    EditReport report;
    report.project = std::move(*project);
    for (const auto& id : request.remove) {
        if (auto removed = removeItem(report.project, id); !removed)
            return tl::unexpected(removed.error());
    }
    for (const auto& [model, order] : request.axes) {
        auto turned = withAxisOrder(std::move(report.project), {model}, order,
                                    projectFile.parent_path(), job);
        if (!turned)
            return tl::unexpected(turned.error());
        report.project = std::move(*turned);
    }
    for (const auto& place : request.places) {
        auto placed = placeModel(std::move(report.project), place, projectFile.parent_path(), job);
        if (!placed)
            return tl::unexpected(placed.error());
        report.project = std::move(placed->project);
        report.remarks.insert(report.remarks.end(), placed->remarks.begin(), placed->remarks.end());
    }
    for (const auto& lines : request.routes) {
        auto added = addRoutes(report.project, projectFile, lines, "", report.remarks, job);
        if (!added)
            return tl::unexpected(added.error());
        report.routesAdded += *added;
    }
    for (const auto& vehicle : request.vehicles) {
        if (auto added = addVehicle(report.project, vehicle, projectFile, report.remarks, job);
            !added)
            return tl::unexpected(added.error());
    }
    for (const auto& [id, interest] : request.interests) {
        if (auto set = setInterest(report.project, id, interest); !set)
            return tl::unexpected(set.error());
    }
    for (const auto& [key, value] : request.settings) {
        auto changed = withSetting(report.project, key, value);
        if (!changed)
            return tl::unexpected(changed.error());
        report.project = std::move(*changed);
    }
    if (auto placed = applyProbes(report, request, projectFile, job); !placed)
        return tl::unexpected(placed.error());
    for (const auto& [ids, locked] :
         {std::pair(&request.lock, true), std::pair(&request.unlock, false)}) {
        for (const auto& id : *ids) {
            if (auto done = setLocked(report.project, id, locked); !done)
                return tl::unexpected(done.error());
        }
    }
    for (const auto& area : request.noProbes)
        putNoProbeArea(report.project, area);
    if (request.probesEvery) {
        auto placed = placeProbesEvery(report.project, *request.probesEvery);
        if (!placed)
            return tl::unexpected(placed.error());
        report.probesAdded += *placed;
    }
    if (auto saved = saveProject(report.project, projectFile); !saved)
        return tl::unexpected(saved.error());
    return report;
}

}  // namespace reflet
