// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/MemoryBench.h"

#include "app/pipeline/ReconstructBench.h"
#include "app/pipeline/Traffic.h"
#include "core/base/Median.h"
#include "core/base/Stopwatch.h"
#include "core/environment/CompressedMap.h"
#include "core/environment/ImageMetrics.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr std::size_t kPlainTexel = 8;  // bytes of RGBA16F
constexpr float kOffMetres = 0.05F;
constexpr float kOffPart = 1e-3F;

bool isOff(float distance, float kept) {
    if (std::isinf(distance) || std::isinf(kept))
        return std::isinf(distance) != std::isinf(kept);
    return std::abs(distance - kept) > std::max(kOffMetres, kOffPart * distance);
}

/// The set as it is after compression; what was lost goes into the report.
RemSet compressedSet(const RemSet& rems, float exposure, MemoryBenchReport& report,
                     const JobContext& job) {
    RemSet kept;
    PsnrAccumulator all;
    std::vector<double> milliseconds;
    std::size_t off = 0;
    for (std::size_t i = 0; i < rems.size() && !job.cancelled(); ++i) {
        job.progress(double(i) / double(rems.size()));
        const ReferenceEnvironmentMap& map = rems[i];
        const Stopwatch watch;
        const CompressedMap small = compressed(map);
        milliseconds.push_back(1e3 * watch.seconds());
        ReferenceEnvironmentMap left = decompressed(small, map.id, map.center);
        const DisplayImage before = displayStrip(map.radiance, exposure);
        const DisplayImage after = displayStrip(left.radiance, exposure);
        PsnrAccumulator one;
        one.add(after, before);
        all.add(after, before);
        if (one.decibels())
            report.worstDecibels =
                std::min(report.worstDecibels.value_or(*one.decibels()), *one.decibels());
        const std::size_t texels = map.distance.texels().size();
        for (std::size_t k = 0; k < texels; ++k)
            off += isOff(map.distance.texels()[k], left.distance.texels()[k]) ? 1 : 0;
        report.texels += texels;
        report.plainBytes += texels * kPlainTexel;
        report.compressedBytes += small.bytes();
        kept.add(std::move(left));
    }
    report.maps = rems.size();
    report.decibels = all.decibels();
    report.milliseconds = median(std::move(milliseconds));
    report.offShare = report.texels > 0 ? double(off) / double(report.texels) : 0.0;
    return kept;
}

}  // namespace

Result<MemoryBenchReport> benchMemory(const PreparedCity& city, const RemSet& rems, int positions,
                                      const JobContext& job) {
    if (rems.empty()) {
        return fail(ErrorCode::Usage, "the project has no reflection probes", city.project().name,
                    "Add some: `reflet-cli edit P.reflet --probes-every 15`.");
    }
    const auto traffic = trafficOf(city.project(), city.folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    MemoryBenchReport report;
    const RemSet kept =
        compressedSet(rems, city.project().exposure, report, job.phase("compressing", 0.0, 0.5));
    const std::vector<glm::dvec3> centers =
        traffic->size() > 0 ? mapCenters(*traffic, std::clamp(positions, 1, 1000))
                            : std::vector<glm::dvec3>{};
    const auto prepared = city.preparedRems(rems);
    const ReconstructionInput input{&city.tracer(), rems, city.diameter(), prepared.get()};
    const JobContext comparing = job.phase("comparing", 0.5, 1.0);
    for (std::size_t i = 0; i < centers.size() && !job.cancelled(); ++i) {
        comparing.progress(double(i) / double(centers.size()));
        report.validity += validityChanges(input, kept, centers[i], city.project().tuning);
    }
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    return report;
}

}  // namespace reflet
