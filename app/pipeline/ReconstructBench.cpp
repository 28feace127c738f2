// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/ReconstructBench.h"

#include "app/pipeline/Reconstruct.h"
#include "app/pipeline/Traffic.h"
#include "core/base/Median.h"
#include "core/base/ParallelFor.h"

#include <algorithm>
#include <limits>

namespace reflet {

namespace {

struct Candidate {
    std::string name;
    Method method;
    PreparedCity city;  ///< with its tuning
    std::vector<double> milliseconds, rays, quads;
};

std::vector<Candidate> candidates(const PreparedCity& city) {
    std::vector<Candidate> out;
    const auto add = [&](const char* name, Method method, const MemSettings& tuning) {
        out.push_back({name, method, city.withTuning(tuning), {}, {}, {}});
    };
    const MemSettings tuning = city.project().tuning;
    add("nearest", Method::Nearest, tuning);
    add("blend", Method::Blend, tuning);
    add("box", Method::Box, tuning);
    MemSettings paper = tuning;
    paper.weighting = Weighting::AsInPaper;
    paper.interpolation = Interpolation::AsInPaper;
    paper.refineAtValidity = paper.traceEdgeTexels = paper.refineHits = false;
    add("mem as in the paper", Method::Mem, paper);
    add("mem", Method::Mem, tuning);
    MemSettings bounded = tuning;
    bounded.errorBound = 1.0;
    add("mem within a texel", Method::Mem, bounded);
    add("dense", Method::Dense, tuning);
    return out;
}

}  // namespace

std::vector<glm::dvec3> mapCenters(const Traffic& traffic, int positions) {
    std::vector<glm::dvec3> centers;
    for (int k = 0; k < positions; ++k) {
        const auto reflector = std::size_t(k) % traffic.size();
        const double station =
            traffic.route(reflector).length() * (double(k) + 0.5) / double(positions);
        const PlacedReflector placed = traffic.atStation(reflector, station);
        for (std::size_t body = 0; body < placed.poses.size(); ++body)
            centers.push_back(placed.mapCenter(body));
    }
    return centers;
}

Result<ReconstructBenchReport> benchReconstruct(const PreparedCity& city, const RemSet& rems,
                                                const Traffic& traffic, int positions,
                                                const JobContext& job) {
    if (traffic.size() == 0 || rems.empty()) {
        return fail(
            ErrorCode::Usage,
            rems.empty() ? "the project has no reflection probes" : "the project has no vehicle",
            city.project().name,
            "Add some: `reflet-cli edit P.reflet --probes-every 15 --vehicle car1=car,ROUTE`.");
    }
    const auto scene = city.scene(job.phase("making the city ready", 0.0, 0.3));
    if (!scene)
        return tl::unexpected(scene.error());
    std::vector<Candidate> cases = candidates(city);
    std::vector<double> reference;
    const std::vector<glm::dvec3> centers = mapCenters(traffic, std::clamp(positions, 1, 1000));
    for (std::size_t i = 0; i < centers.size(); ++i) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        job.phase("measuring", 0.3, 1.0).progress(double(i) / double(centers.size()));
        const auto truth = reconstruct(city, {}, scene->get(), Method::RayTrace, centers[i], job);
        if (!truth && truth.error().code == ErrorCode::Refused)
            continue;
        if (!truth)
            return tl::unexpected(truth.error());
        reference.push_back(truth->statistics.milliseconds);
        for (Candidate& each : cases) {
            double least = std::numeric_limits<double>::infinity();
            for (int turn = 0; turn < 2; ++turn) {
                const auto map =
                    reconstruct(each.city, rems, nullptr, each.method, centers[i], job);
                if (!map)
                    return tl::unexpected(map.error());
                least = std::min(least, map->statistics.milliseconds);
                if (turn == 0) {
                    each.rays.push_back(double(map->statistics.rays));
                    each.quads.push_back(double(map->statistics.quads));
                }
            }
            each.milliseconds.push_back(least);
        }
    }
    if (reference.empty()) {
        return fail(ErrorCode::Refused, "all places along the routes lie inside walls",
                    city.project().name, "Move the routes onto the streets.");
    }
    ReconstructBenchReport report{
        threadLimit(), city.project().tuning.resolution, reference.size(), {}};
    for (const Candidate& each : cases) {
        report.cases.push_back({each.name, median(each.milliseconds), median(reference),
                                median(each.rays), median(each.quads)});
    }
    return report;
}

}  // namespace reflet
