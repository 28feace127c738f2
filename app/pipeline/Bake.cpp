// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Bake.h"

#include "core/baking/EnvironmentBaker.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace reflet {

namespace {

constexpr std::size_t kBytesPerTexel = sizeof(glm::vec3) + sizeof(float);
constexpr std::size_t kRemMemoryLimit = std::size_t(8) << 30;

BakeSettings settingsOf(const Project& project, const Probe& probe) {
    BakeSettings settings = project.bake;
    settings.resolution = probe.resolution.value_or(settings.resolution);
    return settings;
}

double primaryRays(const BakeSettings& settings) {
    const double texels = 6.0 * settings.resolution * settings.resolution;
    return texels * (settings.samplesPerEdge * settings.samplesPerEdge + 1);
}

Result<std::vector<const Probe*>> chosenProbes(const Project& project, const BakeOptions& options) {
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
    std::vector<const Probe*> out;
    std::size_t number = 0;
    for (const auto& probe : project.probes) {
        const bool wanted = options.only.empty() ||
                            std::count(options.only.begin(), options.only.end(), probe.id) > 0;
        if (!wanted)
            continue;
        if (int(number++ % std::size_t(options.shardCount)) + 1 == options.shardIndex)
            out.push_back(&probe);
    }
    return out;
}

/// Bakes one probe into the cache.
Result<void> bakeOne(PreparedCity& city, const Probe& probe, const JobContext& job) {
    const auto scene = city.scene(job);
    if (!scene)
        return tl::unexpected(scene.error());
    const BakeSettings settings = settingsOf(city.project(), probe);
    const glm::dvec3 position = city.inFrame(probe.position);
    const auto map =
        bakeEnvironmentMap(**scene, &city.heightfield(), probe.id, position, settings, job);
    if (!map)
        return tl::unexpected(map.error());
    return city.cache().store(city.mapKey(position, settings), *map);
}

}  // namespace

Result<BakeReport> bakeProbes(PreparedCity& city, const BakeOptions& options,
                              const JobContext& job) {
    const auto probes = chosenProbes(city.project(), options);
    if (!probes)
        return tl::unexpected(probes.error());
    BakeReport report;
    report.probes = probes->size();
    const auto start = std::chrono::steady_clock::now();
    double rays = 0.0;
    for (std::size_t i = 0; i < probes->size(); ++i) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        const Probe& probe = *(*probes)[i];
        const BakeSettings settings = settingsOf(city.project(), probe);
        const std::string key = city.mapKey(city.inFrame(probe.position), settings);
        const JobContext phase = job.phase("baking " + probe.id, double(i) / double(probes->size()),
                                           double(i + 1) / double(probes->size()));
        phase.progress(0.0);
        if (city.cache().find(key)) {
            ++report.reused;
        } else if (const auto done = bakeOne(city, probe, phase); done) {
            ++report.baked;
            rays += primaryRays(settings);
        } else if (done.error().code == ErrorCode::Refused) {
            report.failures.push_back({Severity::Error, "probe-refused", probe.id,
                                       done.error().what, done.error().remedy});
        } else {
            return tl::unexpected(done.error());
        }
        report.bytes += city.cache().bytes(key);
    }
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report.raysPerSecond = report.seconds > 0.0 ? rays / report.seconds : 0.0;
    return report;
}

Result<LoadedRems> loadRems(PreparedCity& city, const JobContext& job) {
    std::size_t bytes = 0;
    for (const auto& probe : city.project().probes) {
        const auto n = std::size_t(settingsOf(city.project(), probe).resolution);
        bytes += 6 * n * n * kBytesPerTexel;
    }
    if (bytes > kRemMemoryLimit) {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("the probes' maps need {:.1f} GB of memory", double(bytes) / 1e9),
                    city.project().name,
                    "Lower bake.resolution with `reflet-cli edit --set bake.resolution=128`.");
    }
    auto report = bakeProbes(city, {}, job);
    if (!report)
        return tl::unexpected(report.error());
    LoadedRems loaded;
    loaded.failures = std::move(report->failures);
    for (const auto& probe : city.project().probes) {
        const glm::dvec3 position = city.inFrame(probe.position);
        auto map = city.cache().find(city.mapKey(position, settingsOf(city.project(), probe)));
        if (!map)
            continue;
        map->id = probe.id;
        map->center = position;
        loaded.rems.add(std::move(*map));
    }
    return loaded;
}

}  // namespace reflet
