// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/ComparedPose.h"

#include "app/pipeline/TrafficMaps.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet {

std::vector<PlacedReflector> ComparedPose::withOthers(const Traffic& traffic) const {
    std::vector<PlacedReflector> all{placed};
    for (std::size_t i = 0; i < traffic.size(); ++i) {
        if (i != reflector)
            all.push_back(traffic.at(i, time));
    }
    return all;
}

std::vector<ComparedPose> spreadPoses(const Traffic& traffic, int count) {
    std::vector<ComparedPose> poses;
    for (int k = 0; k < count; ++k) {
        const auto reflector = std::size_t(k) % traffic.size();
        const int turn = k / int(traffic.size());
        const int turns = (count - 1 - int(reflector)) / int(traffic.size()) + 1;
        ComparedPose pose;
        pose.reflector = reflector;
        pose.placed = traffic.atStation(reflector, 0.0);
        const double length = traffic.route(reflector).length();
        const double margin = std::min(0.5 * pose.placed.vehicle->length(), 0.4 * length);
        const double station = margin + (length - 2.0 * margin) * (turn + 0.5) / double(turns);
        const Drive& drive = traffic.drive(reflector);
        pose.placed = traffic.atStation(reflector, station);
        pose.time = drive.speed > 0.0 ? std::max(0.0, (station - drive.start) / drive.speed) : 0.0;
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
