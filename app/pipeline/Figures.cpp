// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Figures.h"

#include "app/pipeline/TrafficMaps.h"
#include "core/base/Median.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

using References = std::vector<std::shared_ptr<const LocalEnvironmentMap>>;

/// References that were given, when they are of this pose and resolution.
bool fit(const References& references, const PlacedReflector& placed, int resolution) {
    if (references.size() != placed.poses.size())
        return false;
    for (std::size_t body = 0; body < references.size(); ++body) {
        if (references[body]->center != placed.mapCenter(body) ||
            references[body]->radiance.resolution() != resolution) {
            return false;
        }
    }
    return true;
}

/// The maps of the reflector, which is the first of the traffic.
Result<References> traceAll(TrafficMaps& traffic, const PlacedReflector& placed,
                            const JobContext& job) {
    References references;
    for (std::size_t body = 0; body < placed.poses.size(); ++body) {
        const JobContext phase =
            job.phase("tracing the reference", double(body) / double(placed.poses.size()),
                      double(body + 1) / double(placed.poses.size()));
        auto truth = traffic.map(body, Method::RayTrace, phase);
        if (!truth)
            return tl::unexpected(truth.error());
        references.push_back(std::make_shared<const LocalEnvironmentMap>(std::move(*truth)));
    }
    return references;
}

}  // namespace

std::vector<float> FigureTally::add(const LocalEnvironmentMap& ours,
                                    const LocalEnvironmentMap& truth, float exposure) {
    milliseconds.push_back(ours.statistics.milliseconds);
    quads += double(ours.statistics.quads);
    rays += double(ours.statistics.rays);
    uncovered += double(ours.statistics.uncovered);
    vertices += double(ours.statistics.vertices);
    return map.add(ours, truth, exposure);
}

Result<void> FigureTally::addSurfaces(const PreparedCity& city, const RemSet& rems, Method method,
                                      const glm::dvec3& position, const JobContext& job) {
    if (!needsProbes(method) || rems.empty())
        return {};
    const auto scene = city.scene(job);
    if (!scene)
        return tl::unexpected(scene.error());
    TexelSources sources;
    const auto made = reconstruct(city, rems, nullptr, method, position, job, &sources);
    if (!made)
        return tl::unexpected(made.error());
    if (!surfaces)
        surfaces.emplace(**scene, city.tracer());
    surfaces->add(rems, sources, position);
    return {};
}

MethodFigures FigureTally::figures(std::size_t maps) const {
    MethodFigures out;
    out.map = map.figures();
    out.vehicle = vehicle.figures();
    if (surfaces)
        out.surfaces = surfaces->figures();
    out.milliseconds = median(milliseconds);
    out.quads = quads / double(std::max<std::size_t>(1, maps));
    out.rays = rays / double(std::max<std::size_t>(1, maps));
    out.uncoveredShare = vertices > 0.0 ? uncovered / vertices : 0.0;
    return out;
}

Result<PoseFigures> measurePose(const PreparedCity& city, const RemSet& rems,
                                const FiguresRequest& request, const JobContext& job) {
    const PreparedCity tuned = city.withTuning(request.tuning);
    const PlacedReflector& placed = request.placed;
    PoseFigures out{placed.id, placed.station, request.tuning.resolution, {}, request.references};
    std::vector<PlacedReflector> all{placed};
    all.insert(all.end(), request.others.begin(), request.others.end());
    auto traffic = TrafficMaps::create(tuned, rems, std::move(all), job);
    if (!traffic)
        return tl::unexpected(traffic.error());
    if (!fit(out.references, placed, out.resolution)) {
        auto references = traceAll(*traffic, placed, job.phase("tracing the reference", 0.0, 0.7));
        if (!references)
            return tl::unexpected(references.error());
        out.references = std::move(*references);
    }
    for (std::size_t i = 0; i < request.methods.size(); ++i) {
        const Method method = request.methods[i];
        const JobContext phase =
            job.phase("comparing", 0.7 + 0.3 * double(i) / double(request.methods.size()), 1.0);
        phase.progress(0.0);
        FigureTally tally;
        for (std::size_t body = 0; body < placed.poses.size(); ++body) {
            if (job.cancelled())
                return tl::unexpected(JobContext::cancelledError());
            const LocalEnvironmentMap& truth = *out.references[body];
            if (method == Method::RayTrace) {
                tally.add(truth, truth, city.project().exposure);
                continue;
            }
            const auto map = traffic->map(body, method, phase);
            if (!map)
                return tl::unexpected(map.error());
            tally.add(*map, truth, city.project().exposure);
            auto traced = tally.addSurfaces(tuned, rems, method, placed.mapCenter(body), phase);
            if (!traced)
                return tl::unexpected(traced.error());
        }
        out.methods[method] = tally.figures(placed.poses.size());
    }
    return out;
}

}  // namespace reflet
