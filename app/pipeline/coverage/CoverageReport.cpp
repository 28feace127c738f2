// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/CoverageReport.h"

#include "core/base/Stopwatch.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <map>

namespace reflet {

namespace {

std::vector<float> seenBy(const SampleCoverage& coverage, int atLeast) {
    std::vector<float> values;
    values.reserve(coverage.seenBy.size());
    for (const unsigned char count : coverage.seenBy)
        values.push_back(int(count) >= atLeast ? 1.0F : 0.0F);
    return values;
}

void addLines(const PreparedCity& city, CoverageReport& report) {
    const CoveragePlan& plan = report.plan;
    if (plan.lines.empty())
        return;
    report.stretches =
        coveredStretches(report.demand, report.samples, plan.lines, CoverageReport::kStretch);
    report.figures = lineFigures(report.stretches);
    for (std::size_t line = 0; line < plan.lines.size(); ++line) {
        std::vector<CoveredStretch> own;
        for (const CoveredStretch& stretch : report.stretches) {
            if (stretch.line == line)
                own.push_back(stretch);
        }
        RouteCoverage route{plan.lines[line].id, plan.names[line], {}, lineFigures(own)};
        for (const RouteSpec& spec : city.project().routes) {
            if (spec.id == route.id)
                route.attributes = spec.attributes;
        }
        report.routes.push_back(std::move(route));
    }
    for (const CoveredStretch& stretch :
         worstStretches(report.stretches, plan.lines, CoverageReport::kWorstPlaces,
                        CoverageReport::kWorstApart)) {
        const glm::dvec3 middle =
            plan.lines[stretch.line].route->at(0.5 * (stretch.from + stretch.to));
        report.worst.push_back({plan.lines[stretch.line].id, plan.names[stretch.line], stretch.from,
                                stretch.to, middle + city.project().frame.origin,
                                stretch.coverage});
    }
}

/// The object that a patch belongs to: what a ray from outside meets there.
std::uint32_t objectAt(const RadianceScene& scene, const SurfacePatch& patch) {
    constexpr float kBefore = 2.0F, kBehind = 2.0F;  // metres; heightfields know walls to a cell
    const glm::vec3 origin = glm::vec3(patch.middle) + kBefore * patch.normal;
    const SceneHit hit = scene.intersect(origin, -patch.normal);
    if (hit.triangle == kNone || hit.distance > kBefore + kBehind)
        return kNone;
    const CityModel& city = scene.city();
    return city.surfaces[city.triangles[hit.triangle].surface].object;
}

void addWalls(const PreparedCity& city, const RadianceScene& scene, CoverageReport& report) {
    struct Sum {
        double reflected = 0.0, uncovered = 0.0;
        glm::dvec3 middle{0.0};
    };
    std::map<std::uint32_t, Sum> sums;
    for (const SurfacePatch& patch : report.patches) {
        if (!patch.wall)
            continue;
        const std::uint32_t object = objectAt(scene, patch);
        Sum& sum = sums[object];
        sum.reflected += patch.area;
        report.reflectedWalls += patch.area;
        if (patch.coverage >= kUncoveredBelow)
            continue;
        sum.uncovered += patch.area;
        sum.middle += patch.area * patch.middle;
        report.uncoveredWalls += patch.area;
    }
    for (const auto& [object, sum] : sums) {
        if (object == kNone || !(sum.uncovered > 0.0))
            continue;
        const CityObject& of = city.city().objects[object];
        report.objects.push_back({of.id, of.typeName.empty() ? toString(of.type) : of.typeName,
                                  sum.reflected, sum.uncovered,
                                  sum.middle / sum.uncovered + city.project().frame.origin});
    }
    std::stable_sort(report.objects.begin(), report.objects.end(),
                     [](const auto& x, const auto& y) { return x.uncovered > y.uncovered; });
}

void addProbes(const PreparedCity& city, const RemSet& rems, const ServiceRule& rule,
               CoverageReport& report) {
    const auto& probes = city.project().probes;
    const double n = double(std::max<std::size_t>(report.demand.samples.size(), 1));
    std::vector<double> serves(probes.size(), 0.0), loss(probes.size(), 0.0);
    std::vector<float> second(report.demand.samples.size(), 0.0F);
    const SampleIndex index(report.demand);
    for (std::size_t k = 0; k < probes.size(); ++k) {
        for (const ServiceRow::Entry& entry :
             serviceRow(report.demand, index, rule, rems[k]).entries) {
            if (report.samples.rem[entry.sample] != k)
                second[entry.sample] = std::max(second[entry.sample], entry.service);
        }
    }
    for (std::size_t i = 0; i < second.size(); ++i) {
        const std::uint32_t k = report.samples.rem[i];
        if (k == SampleCoverage::kNoRem)
            continue;
        serves[k] += 1.0 / n;
        loss[k] += double(report.samples.best[i] - second[i]) / n;
    }
    for (std::size_t k = 0; k < probes.size(); ++k)
        report.probes.push_back({probes[k].id, serves[k], loss[k]});
}

}  // namespace

Result<CoverageReport> reportCoverage(const PreparedCity& city, const CoverageOptions& options,
                                      const JobContext& job) {
    const Stopwatch watch;
    CoverageReport report;
    auto plan = coveragePlan(city, options);
    if (!plan)
        return tl::unexpected(plan.error());
    report.plan = std::move(*plan);
    const auto rems = probeSights(city, city.project().probes, job.phase("looking", 0.0, 0.3));
    if (!rems)
        return tl::unexpected(rems.error());
    const ServiceRule rule(city.heightfield().grid);
    const JobContext sampling = job.phase("sampling", 0.3, 0.6);
    report.demand = sampleToError(report.plan, city.tracer(), options, [&](const Demand& demand) {
        return sampling.cancelled() ? std::vector<float>{} : coverageOf(demand, rule, *rems).best;
    });
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    report.samples = coverageOf(report.demand, rule, *rems);
    report.coverage = estimateOf(report.samples.best);
    report.seen = estimateOf(seenBy(report.samples, 1));
    report.seenTwice = estimateOf(seenBy(report.samples, 2));
    const auto prepared = city.preparedRems(*rems);
    report.shown = estimateOf(
        coverageAtRunTime(report.demand, rule, city.tracer(), *prepared, city.project().tuning));
    addLines(city, report);
    const auto scene = city.scene(job.phase("surfaces", 0.6, 0.9));
    if (!scene)
        return tl::unexpected(scene.error());
    report.patches = surfacePatches(report.demand, report.samples, CoverageReport::kPatch);
    addWalls(city, **scene, report);
    addProbes(city, *rems, rule, report);
    report.seconds = watch.seconds();
    return report;
}

}  // namespace reflet
