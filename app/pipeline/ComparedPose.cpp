// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/ComparedPose.h"

#include "app/pipeline/TrafficMaps.h"
#include "core/rendering/MapBodies.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet {

namespace {

/// Where in its stretch of a route a pose stands: a share that no spacing of probes repeats, so
/// that none falls on a probe by design.
constexpr double kPhase = 0.381966;

}  // namespace

std::vector<PlacedReflector> ComparedPose::withOthers(const Traffic& traffic) const {
    std::vector<PlacedReflector> all{placed};
    for (std::size_t i = 0; i < traffic.size(); ++i) {
        if (i != reflector)
            all.push_back(traffic.at(i, time));
    }
    return all;
}

std::vector<std::size_t> mirrorsOf(const Traffic& traffic) {
    std::vector<std::size_t> mirrors;
    for (std::size_t i = 0; i < traffic.size(); ++i) {
        if (reflectsAnything(*traffic.drive(i).vehicle))
            mirrors.push_back(i);
    }
    return mirrors;
}

std::vector<ComparedPose> spreadPoses(const Traffic& traffic, int count) {
    const std::vector<std::size_t> mirrors = mirrorsOf(traffic);
    std::vector<ComparedPose> poses;
    for (int k = 0; k < count; ++k) {
        const auto place = std::size_t(k) % mirrors.size();
        const std::size_t reflector = mirrors[place];
        const int turn = k / int(mirrors.size());
        const int turns = (count - 1 - int(place)) / int(mirrors.size()) + 1;
        ComparedPose pose;
        pose.reflector = reflector;
        pose.placed = traffic.atStation(reflector, 0.0);
        const double length = traffic.route(reflector).length();
        const double margin = std::min(0.5 * pose.placed.vehicle->length(), 0.4 * length);
        const Drive& drive = traffic.drive(reflector);
        const double station =
            drive.speed > 0.0 ? margin + (length - 2.0 * margin) * (turn + kPhase) / double(turns)
                              : drive.start;  // who stands is compared where it stands
        pose.placed = traffic.atStation(reflector, station);
        pose.time = traffic.secondsAt(reflector, station);
        poses.push_back(std::move(pose));
    }
    return poses;
}

Result<void> traceReferences(const PreparedCity& city, const Traffic& traffic,
                             std::vector<ComparedPose>& poses, std::vector<Diagnostic>& remarks,
                             const JobContext& job) {
    std::vector<ComparedPose> kept;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        job.progress(double(i) / double(poses.size()));
        ComparedPose& pose = poses[i];
        auto maps = TrafficMaps::create(city, {}, pose.withOthers(traffic), job);
        if (!maps)
            return tl::unexpected(maps.error());
        bool refused = false;
        for (std::size_t body = 0; body < pose.placed.poses.size() && !refused; ++body) {
            auto truth = maps->map(body, Method::RayTrace, job);
            if (truth) {
                pose.truth.push_back(std::move(*truth));
            } else if (truth.error().code == ErrorCode::Refused) {
                remarks.push_back({Severity::Warning, "pose-refused", pose.placed.id,
                                   fmt::format("A pose {:.0f} m along the route was left out: {}",
                                               pose.placed.station, truth.error().what),
                                   "Move the route away from the wall."});
                refused = true;
            } else {
                return tl::unexpected(truth.error());
            }
        }
        if (!refused)
            kept.push_back(std::move(pose));
    }
    poses = std::move(kept);
    return {};
}

}  // namespace reflet
