// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Compare.h"

#include "app/pipeline/ComparedPose.h"
#include "app/pipeline/Pop.h"
#include "app/pipeline/VehicleComparison.h"
#include "core/rendering/MapBodies.h"

namespace reflet {

namespace {

Result<void> comparePose(const PreparedCity& city, const RemSet& rems,
                         const CompareOptions& options, const ComparedPose& pose,
                         VehicleComparison& vehicle, std::map<Method, FigureTally>& tallies,
                         SheetRow& row, const JobContext& job) {
    for (const Method method : options.methods) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        std::vector<LocalEnvironmentMap> maps;
        SheetCell cell{toString(method), {}, {}, std::nullopt, 0.0};
        FlipAccumulator pool;
        for (std::size_t body = 0; body < vehicle.maps().bodies().size(); ++body) {
            const bool compared = body < pose.truth.size();
            if (compared && method == Method::RayTrace) {
                maps.push_back(pose.truth[body]);
            } else if (!reflectsAnything(*vehicle.maps().bodies()[body].vehicle)) {
                maps.emplace_back();
            } else {
                auto map = vehicle.maps().map(body, method, job);
                if (!map)
                    return tl::unexpected(map.error());
                maps.push_back(std::move(*map));
            }
            if (!compared)
                continue;
            pool.add(tallies[method].add(maps.back(), pose.truth[body], city.project().exposure));
            auto traced =
                tallies[method].addSurfaces(city, rems, method, pose.placed.mapCenter(body), job);
            if (!traced)
                return traced;
        }
        cell.mapFlip = pool.mean().value_or(0.0);
        if (auto added = vehicle.add(method, maps, tallies[method], cell, job); !added)
            return added;
        row.methods.push_back(std::move(cell));
    }
    return {};
}

Result<void> checkComparable(const PreparedCity& city, const Traffic& traffic,
                             const CompareOptions& options) {
    if (mirrorsOf(traffic).empty()) {
        return fail(
            ErrorCode::Usage, "the project has no vehicle to compare", city.project().name,
            "Add one: `reflet-cli edit P.reflet --route LINE.geojson --vehicle tram1=tram,ROUTE`.");
    }
    if (city.project().probes.empty()) {
        return fail(ErrorCode::Usage, "the project has no reflection probes", city.project().name,
                    "Place some: `reflet-cli edit P.reflet --probes-every 15`.");
    }
    if (options.poses < 1 || options.poses > 10'000) {
        return fail(ErrorCode::Usage, "the number of poses is out of range", "--poses",
                    "Take 1 to 10000.");
    }
    if (options.drive && !(*options.drive >= kPopStep && *options.drive <= 10'000.0)) {
        return fail(ErrorCode::Usage, "the length of the drive is out of range", "--drive",
                    "Take 0.5 to 10000 metres; 20 is a good start.");
    }
    return {};
}

/// The name of the route that a reflector drives; its id where it has none.
std::string streetOf(const Project& project, const PlacedReflector& placed) {
    for (const Reflector& reflector : project.reflectors) {
        if (reflector.id != placed.id)
            continue;
        for (const RouteSpec& route : project.routes) {
            if (route.id == reflector.route)
                return route.name.empty() ? route.id : route.name;
        }
    }
    return {};
}

}  // namespace

Result<CompareReport> compareMethods(const PreparedCity& city, const CompareOptions& options,
                                     const JobContext& job) {
    const auto traffic = trafficOf(city.project(), city.folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    if (auto sound = checkComparable(city, *traffic, options); !sound)
        return tl::unexpected(sound.error());
    auto rems = loadRems(city, job.phase("baking", 0.0, 0.4));
    if (!rems)
        return tl::unexpected(rems.error());

    CompareReport report;
    report.remarks = std::move(rems->failures);
    std::vector<ComparedPose> poses = spreadPoses(*traffic, options.poses);
    if (auto traced = traceReferences(city, *traffic, poses, report.remarks,
                                      job.phase("tracing the reference", 0.4, 0.7));
        !traced) {
        return tl::unexpected(traced.error());
    }
    std::map<Method, FigureTally> tallies;
    VehicleComparison vehicle(city, *traffic, rems->rems, options);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const JobContext phase =
            job.phase("comparing", 0.7 + 0.3 * double(i) / double(poses.size()), 1.0);
        phase.progress(0.0);
        if (auto begun = vehicle.begin(poses[i], i + 1, phase); !begun)
            return tl::unexpected(begun.error());
        SheetRow row{poses[i].placed.id,
                     streetOf(city.project(), poses[i].placed),
                     poses[i].placed.station,
                     {},
                     {},
                     {}};
        auto done = comparePose(city, rems->rems, options, poses[i], vehicle, tallies, row, phase);
        if (!done)
            return tl::unexpected(done.error());
        row.reference = vehicle.reference();
        auto all = vehicle.finish();
        if (!all)
            return tl::unexpected(all.error());
        row.all = std::move(*all);
        report.rows.push_back(std::move(row));
        report.maps += poses[i].truth.size();
    }
    report.poses = poses.size();
    report.pictures = std::move(vehicle.pictures);
    for (const auto& [method, tally] : tallies)
        report.methods[toString(method)] = tally.figures(report.maps);
    if (options.drive) {
        auto pops = measurePops(city, *traffic, rems->rems, options.methods, *options.drive,
                                job.phase("driving", 0.9, 1.0));
        if (!pops)
            return tl::unexpected(pops.error());
        for (const auto& [method, pop] : *pops)
            report.methods[toString(method)].pop = pop;
    }
    return report;
}

}  // namespace reflet
