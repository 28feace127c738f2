// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Bake.h"

#include "core/baking/EnvironmentBaker.h"
#include "core/base/ParallelFor.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace reflet {

namespace {

constexpr std::size_t kBytesPerTexel = sizeof(glm::vec3) + sizeof(float);
constexpr std::size_t kRemMemoryLimit = std::size_t(8) << 30;

double primaryRays(const BakeSettings& settings) {
    const double texels = 6.0 * settings.resolution * settings.resolution;
    return texels * (settings.samplesPerEdge * settings.samplesPerEdge + 1);
}

Result<std::vector<Probe>> chosenProbes(const Project& project, const BakeOptions& options) {
    if (options.shardCount < 1 || options.shardIndex < 1 ||
        options.shardIndex > options.shardCount) {
        return fail(
            ErrorCode::Usage,
            fmt::format("there is no shard {} of {}", options.shardIndex, options.shardCount),
            "--shard", "Shards count from 1: --shard 1/4 .. 4/4.");
    }
    for (const auto& id : options.only) {
        const bool known = std::any_of(project.probes.begin(), project.probes.end(),
                                       [&](const Probe& probe) { return probe.id == id; });
        if (!known)
            return fail(ErrorCode::Usage, "the project has no probe of that name", id,
                        "See the project file.");
    }
    std::vector<Probe> out;
    std::size_t number = 0;
    for (const auto& probe : project.probes) {
        const bool wanted = options.only.empty() ||
                            std::count(options.only.begin(), options.only.end(), probe.id) > 0;
        if (!wanted)
            continue;
        if (int(number++ % std::size_t(options.shardCount)) + 1 == options.shardIndex)
            out.push_back(probe);
    }
    return out;
}

/// What the cache holds of the probes, and the rest baked. Null for probes that were refused.
Result<std::vector<RemSet::Pointer>> gatherMaps(const PreparedCity& city,
                                                const std::vector<Probe>& probes,
                                                BakeReport& report, const JobContext& job) {
    const auto start = std::chrono::steady_clock::now();
    report.probes = probes.size();
    double rays = 0.0;
    std::vector<RemSet::Pointer> maps = cachedRems(city, probes, job);
    for (std::size_t i = 0; i < probes.size(); ++i) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        const Probe& probe = probes[i];
        const JobContext phase = job.phase("baking " + probe.id, double(i) / double(probes.size()),
                                           double(i + 1) / double(probes.size()));
        phase.progress(0.0);
        if (maps[i]) {
            ++report.reused;
        } else if (auto baked = bakeProbe(city, probe, phase); baked) {
            maps[i] = std::move(*baked);
            ++report.baked;
            rays += primaryRays(bakeSettingsOf(city.project(), probe));
        } else if (baked.error().code == ErrorCode::Refused) {
            report.failures.push_back({Severity::Error, "probe-refused", probe.id,
                                       baked.error().what, baked.error().remedy});
        } else {
            return tl::unexpected(baked.error());
        }
        report.bytes += city.cache().bytes(probeKey(city, probe));
    }
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report.raysPerSecond = report.seconds > 0.0 ? rays / report.seconds : 0.0;
    return maps;
}

}  // namespace

BakeSettings bakeSettingsOf(const Project& project, const Probe& probe) {
    BakeSettings settings = project.bake;
    settings.resolution = probe.resolution.value_or(settings.resolution);
    return settings;
}

std::string probeKey(const PreparedCity& city, const Probe& probe) {
    return city.mapKey(city.inFrame(probe.position), bakeSettingsOf(city.project(), probe));
}

RemSet::Pointer cachedRem(const PreparedCity& city, const Probe& probe) {
    auto map = city.cache().find(probeKey(city, probe));
    if (!map)
        return nullptr;
    map->id = probe.id;
    map->center = city.inFrame(probe.position);
    return std::make_shared<const ReferenceEnvironmentMap>(std::move(*map));
}

std::vector<RemSet::Pointer> cachedRems(const PreparedCity& city, const std::vector<Probe>& probes,
                                        const JobContext& job) {
    std::vector<RemSet::Pointer> maps(probes.size());
    parallelFor(0, probes.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !job.cancelled(); ++i)
            maps[i] = cachedRem(city, probes[i]);
    });
    return maps;
}

Result<RemSet::Pointer> bakeProbe(const PreparedCity& city, const Probe& probe,
                                  const JobContext& job) {
    const auto scene = city.scene(job);
    if (!scene)
        return tl::unexpected(scene.error());
    const glm::dvec3 position = city.inFrame(probe.position);
    auto map = bakeEnvironmentMap(**scene, &city.heightfield(), probe.id, position,
                                  bakeSettingsOf(city.project(), probe), job);
    if (!map)
        return tl::unexpected(map.error());
    if (auto stored = city.cache().store(probeKey(city, probe), *map); !stored)
        return tl::unexpected(stored.error());
    // Read again, so that a fresh and a reused map are the same bits.
    if (auto cached = cachedRem(city, probe))
        return cached;
    return fail(ErrorCode::WriteFailed, "a map that was just stored cannot be read again",
                city.cache().pathOf(probeKey(city, probe)).string(),
                "Check the disk that the project lies on.");
}

Result<BakeReport> bakeProbes(const PreparedCity& city, const BakeOptions& options,
                              const JobContext& job) {
    const auto probes = chosenProbes(city.project(), options);
    if (!probes)
        return tl::unexpected(probes.error());
    BakeReport report;
    if (auto maps = gatherMaps(city, *probes, report, job); !maps)
        return tl::unexpected(maps.error());
    return report;
}

Result<LoadedRems> loadRems(const PreparedCity& city, const JobContext& job) {
    std::size_t bytes = 0;
    for (const auto& probe : city.project().probes) {
        const auto n = std::size_t(bakeSettingsOf(city.project(), probe).resolution);
        bytes += 6 * n * n * kBytesPerTexel;
    }
    if (bytes > kRemMemoryLimit) {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("the probes' maps need {:.1f} GB of memory", double(bytes) / 1e9),
                    city.project().name,
                    "Lower bake.resolution with `reflet-cli edit --set bake.resolution=128`.");
    }
    BakeReport report;
    auto maps = gatherMaps(city, city.project().probes, report, job);
    if (!maps)
        return tl::unexpected(maps.error());
    LoadedRems loaded;
    loaded.failures = std::move(report.failures);
    for (auto& map : *maps) {
        if (map)
            loaded.rems.add(std::move(map));
    }
    return loaded;
}

}  // namespace reflet
