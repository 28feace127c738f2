// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/CoverageFigures.h"

#include "core/base/ParallelFor.h"
#include "core/reconstruction/MemVertexTracer.h"
#include "core/reconstruction/RemSelection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace reflet {

namespace {

constexpr std::size_t kGrain = 512;  // samples to a task
constexpr double kQuantile = 0.05;

/// The REMs within reach of each sample, found by a coarse lattice over their centres.
class NearRems {
public:
    explicit NearRems(const RemSet& rems) : m_rems(rems) {
        for (std::size_t k = 0; k < rems.size(); ++k)
            m_cells[key(rems[k].center, 0, 0)].push_back(std::uint32_t(k));
    }
    template <class Visit>
    void forEach(const glm::dvec3& position, const Visit& visit) const {
        for (int dj = -1; dj <= 1; ++dj) {
            for (int di = -1; di <= 1; ++di) {
                const auto found = m_cells.find(key(position, di, dj));
                if (found == m_cells.end())
                    continue;
                for (const std::uint32_t k : found->second)
                    visit(k, m_rems[k]);
            }
        }
    }

private:
    using Key = std::pair<std::int64_t, std::int64_t>;
    static Key key(const glm::dvec3& p, int di, int dj) {
        return {std::int64_t(std::floor(p.x / ServiceRule::kReach)) + di,
                std::int64_t(std::floor(p.y / ServiceRule::kReach)) + dj};
    }
    const RemSet& m_rems;
    std::map<Key, std::vector<std::uint32_t>> m_cells;
};

}  // namespace

SampleCoverage coverageOf(const Demand& demand, const ServiceRule& rule, const RemSet& rems) {
    const NearRems near(rems);
    SampleCoverage out;
    const std::size_t n = demand.samples.size();
    out.best.assign(n, 0.0F);
    out.rem.assign(n, SampleCoverage::kNoRem);
    out.seenBy.assign(n, 0);
    parallelFor(0, n, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            near.forEach(demand.samples[i].vehicle, [&](std::uint32_t k,
                                                        const ReferenceEnvironmentMap& rem) {
                const auto service = float(rule.service(demand.samples[i], rem));
                if (service <= 0.0F)
                    return;
                out.seenBy[i] += out.seenBy[i] < 255 ? 1 : 0;
                // Ties by index: the visits come in no order that means anything.
                if (service > out.best[i] || (service == out.best[i] && k < out.rem[i])) {
                    out.best[i] = service;
                    out.rem[i] = k;
                }
            });
        }
    });
    return out;
}

std::vector<float> coverageAtRunTime(const Demand& demand, const ServiceRule& rule,
                                     const HeightfieldTracer& tracer, const PreparedRems& rems,
                                     const MemSettings& settings) {
    std::vector<float> served(demand.samples.size(), 0.0F);
    ReconstructionInput input;
    input.tracer = &tracer;
    input.rems = rems.rems();
    input.prepared = &rems;
    parallelFor(0, served.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const DemandSample& sample = demand.samples[i];
            const RemCandidates candidates = input.candidates(sample.vehicle, settings);
            const MemVertexTracer chooser(input, candidates, sample.vehicle, false);
            const MemVertex vertex =
                chooser.at(glm::dvec3(sample.direction), double(sample.distance));
            if (vertex.uncovered)
                continue;
            const auto part = [&](std::int8_t candidate, double weight) {
                return candidate < 0 || !(weight > 0.0)
                           ? 0.0
                           : weight * rule.likeness(
                                          sample,
                                          input.rems[candidates.rems[std::size_t(candidate)].rem]);
            };
            served[i] = float(part(vertex.a, vertex.weightA) + part(vertex.b, vertex.weightB));
        }
    });
    return served;
}

std::vector<CoveredStretch> coveredStretches(const Demand& demand, const SampleCoverage& coverage,
                                             const std::vector<DemandLine>& lines, double length) {
    std::vector<CoveredStretch> stretches;
    std::vector<std::size_t> firstOf;
    std::vector<double> stepOf;
    for (std::size_t line = 0; line < lines.size(); ++line) {
        const double whole = lines[line].route->length();
        const auto count = std::max<std::size_t>(1, std::size_t(std::ceil(whole / length - 1e-9)));
        firstOf.push_back(stretches.size());
        stepOf.push_back(whole / double(count));
        for (std::size_t k = 0; k < count; ++k) {
            stretches.push_back({std::uint32_t(line), double(k) * stepOf.back(),
                                 double(k + 1) * stepOf.back(), 0, 0.0, 0.0, 0.0});
        }
    }
    for (std::size_t i = 0; i < demand.samples.size(); ++i) {
        const DemandSample& sample = demand.samples[i];
        const std::size_t end =
            sample.line + 1 < firstOf.size() ? firstOf[sample.line + 1] : stretches.size();
        const auto k = std::size_t(std::max(0.0, double(sample.station) / stepOf[sample.line]));
        CoveredStretch& stretch = stretches[std::min(firstOf[sample.line] + k, end - 1)];
        ++stretch.samples;
        stretch.coverage += double(coverage.best[i]);
        stretch.seen += coverage.seenBy[i] >= 1 ? 1.0 : 0.0;
        stretch.seenTwice += coverage.seenBy[i] >= 2 ? 1.0 : 0.0;
    }
    for (CoveredStretch& stretch : stretches) {
        const double n = double(std::max<std::size_t>(stretch.samples, 1));
        stretch.coverage /= n;
        stretch.seen /= n;
        stretch.seenTwice /= n;
    }
    return stretches;
}

LineFigures lineFigures(const std::vector<CoveredStretch>& stretches) {
    LineFigures figures;
    figures.worst = 1.0;
    std::vector<std::pair<double, double>> byCoverage;  // coverage, metres
    double gap = 0.0;
    std::uint32_t line = 0;
    for (const CoveredStretch& stretch : stretches) {
        if (stretch.samples == 0)
            continue;
        const double metres = stretch.to - stretch.from;
        figures.length += metres;
        figures.coverage += metres * stretch.coverage;
        figures.seen += metres * stretch.seen;
        figures.seenTwice += metres * stretch.seenTwice;
        byCoverage.emplace_back(stretch.coverage, metres);
        if (stretch.coverage <= figures.worst) {
            figures.worst = stretch.coverage;
            figures.worstLine = stretch.line;
            figures.worstStation = 0.5 * (stretch.from + stretch.to);
        }
        gap = stretch.coverage < kGapBelow ? (stretch.line == line ? gap : 0.0) + metres : 0.0;
        line = stretch.line;
        figures.largestGap = std::max(figures.largestGap, gap);
    }
    if (byCoverage.empty()) {
        figures.worst = 0.0;
        return figures;
    }
    figures.coverage /= figures.length;
    figures.seen /= figures.length;
    figures.seenTwice /= figures.length;
    std::sort(byCoverage.begin(), byCoverage.end());
    double passed = 0.0;
    for (const auto& [coverage, metres] : byCoverage) {
        figures.p05 = coverage;
        passed += metres;
        if (passed >= kQuantile * figures.length)
            break;
    }
    return figures;
}

std::vector<CoveredStretch> worstStretches(const std::vector<CoveredStretch>& stretches,
                                           const std::vector<DemandLine>& lines, std::size_t most,
                                           double apart) {
    std::vector<CoveredStretch> ordered;
    for (const CoveredStretch& stretch : stretches) {
        if (stretch.samples > 0)
            ordered.push_back(stretch);
    }
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const auto& x, const auto& y) { return x.coverage < y.coverage; });
    const auto middle = [&](const CoveredStretch& s) {
        return glm::dvec2(lines[s.line].route->at(0.5 * (s.from + s.to)));
    };
    std::vector<CoveredStretch> worst;
    for (const CoveredStretch& stretch : ordered) {
        if (worst.size() == most)
            break;
        const bool close = std::any_of(worst.begin(), worst.end(), [&](const CoveredStretch& w) {
            return glm::distance(middle(w), middle(stretch)) < apart;
        });
        if (!close)
            worst.push_back(stretch);
    }
    return worst;
}

std::vector<SurfacePatch> surfacePatches(const Demand& demand, const SampleCoverage& coverage,
                                         double size) {
    std::map<std::array<std::int64_t, 3>, SurfacePatch> patches;
    for (std::size_t i = 0; i < demand.samples.size(); ++i) {
        const DemandSample& sample = demand.samples[i];
        if (sample.sky())
            continue;
        const glm::dvec3 point = sample.point();
        const glm::dvec3 cube = glm::floor(point / size);
        SurfacePatch& patch =
            patches[{std::int64_t(cube.x), std::int64_t(cube.y), std::int64_t(cube.z)}];
        patch.middle += point;
        patch.normal += sample.normal;
        patch.coverage += double(coverage.best[i]);
        ++patch.samples;
    }
    std::vector<SurfacePatch> out;
    for (auto& [cube, patch] : patches) {
        const double n = double(patch.samples);
        patch.middle /= n;
        patch.coverage /= n;
        const float length = glm::length(patch.normal);
        patch.normal = length > 0.0F ? patch.normal / length : glm::vec3(0.0F, 0.0F, 1.0F);
        const glm::vec3 a = glm::abs(patch.normal);
        patch.area = size * size / double(a.x + a.y + a.z);
        patch.wall = a.z < std::sqrt(0.5F);
        out.push_back(patch);
    }
    return out;
}

}  // namespace reflet
