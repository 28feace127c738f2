// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Bake.h"

#include "app/pipeline/GlRender.h"
#include "core/baking/EnvironmentBaker.h"
#include "core/base/ParallelFor.h"
#include "core/base/Stopwatch.h"

#include <fmt/format.h>

#include <algorithm>

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
/// baker: nullopt takes what there is of either, and bakes with rays.
Result<std::vector<RemSet::Pointer>> gatherMaps(const PreparedCity& city,
                                                const std::vector<Probe>& probes,
                                                std::optional<Baker> baker, BakeReport& report,
                                                const JobContext& job) {
    const Stopwatch watch;
    const Baker by = baker.value_or(Baker::Rays);
    report.probes = probes.size();
    double rays = 0.0;
    std::vector<RemSet::Pointer> maps = cachedRems(city, probes, job, baker);
    report.reused = std::size_t(
        std::count_if(maps.begin(), maps.end(), [](const auto& map) { return map != nullptr; }));
    if (by == Baker::Rays)
        report.kept = keepRems(city, probes, maps, job);
    for (std::size_t i = 0; i < probes.size(); ++i) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        const Probe& probe = probes[i];
        const JobContext phase = job.phase("baking " + probe.id, double(i) / double(probes.size()),
                                           double(i + 1) / double(probes.size()));
        phase.progress(0.0);
        if (maps[i]) {
            // nothing to do
        } else if (auto baked = bakeProbe(city, probe, phase, by); baked) {
            maps[i] = std::move(*baked);
            ++report.baked;
            rays += primaryRays(bakeSettingsOf(city.project(), probe));
        } else if (baked.error().code == ErrorCode::Refused) {
            report.failures.push_back({Severity::Error, "probe-refused", probe.id,
                                       baked.error().what, baked.error().remedy});
        } else {
            return tl::unexpected(baked.error());
        }
        report.bytes += city.cache().bytes(probeKey(city, probe, by));
    }
    report.seconds = watch.seconds();
    report.raysPerSecond = report.seconds > 0.0 ? rays / report.seconds : 0.0;
    return maps;
}

std::string placeKeyOf(const PreparedCity& city, const Probe& probe) {
    return city.placeKey(city.inFrame(probe.position), bakeSettingsOf(city.project(), probe));
}

/// What the city shows, in cells of its own.
Result<std::shared_ptr<const CellContents>> contentsAround(const PreparedCity& city,
                                                           const JobContext& job) {
    return city.contents(cellsOver(city.city().bounds()), job);
}

}  // namespace

BakeSettings bakeSettingsOf(const Project& project, const Probe& probe) {
    BakeSettings settings = project.bake;
    settings.resolution = probe.resolution.value_or(settings.resolution);
    return settings;
}

std::string probeKey(const PreparedCity& city, const Probe& probe, Baker baker) {
    return city.mapKey(city.inFrame(probe.position), bakeSettingsOf(city.project(), probe), baker);
}

RemSet::Pointer cachedRem(const PreparedCity& city, const Probe& probe,
                          std::optional<Baker> baker) {
    auto map = city.cache().find(probeKey(city, probe, baker.value_or(Baker::Rays)));
    if (!map && !baker)
        map = city.cache().find(probeKey(city, probe, Baker::OpenGl));
    if (!map)
        return nullptr;
    map->id = probe.id;
    map->center = city.inFrame(probe.position);
    return std::make_shared<const ReferenceEnvironmentMap>(std::move(*map));
}

std::vector<RemSet::Pointer> cachedRems(const PreparedCity& city, const std::vector<Probe>& probes,
                                        const JobContext& job, std::optional<Baker> baker) {
    std::vector<RemSet::Pointer> maps(probes.size());
    parallelFor(0, probes.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !job.cancelled(); ++i)
            maps[i] = cachedRem(city, probes[i], baker);
    });
    return maps;
}

std::optional<Sight> sightOf(const PreparedCity& city, const Probe& probe) {
    const std::string key = probeKey(city, probe);
    for (Sight& sight : city.sights().find(placeKeyOf(city, probe))) {
        if (sight.map == key)
            return std::move(sight);
    }
    return std::nullopt;
}

RemSet::Pointer keptRem(const PreparedCity& city, const Probe& probe, const JobContext& job) {
    for (Sight& sight : city.sights().find(placeKeyOf(city, probe))) {
        if (!city.cache().contains(sight.map))
            continue;
        const auto contents = city.contents(sight.seen.grid, job);
        if (!contents)
            return nullptr;
        if (contentOf(sight.seen, **contents) != sight.content)
            continue;
        // What stands around the probe may have become a solid, or ground, without being seen.
        const auto scene = city.scene(job);
        const glm::dvec3 position = city.inFrame(probe.position);
        if (!scene || placeError(**scene, &city.heightfield(), probe.id, position))
            return nullptr;
        const std::string key = probeKey(city, probe);
        if (!city.cache().share(sight.map, key))
            return nullptr;
        sight.map = key;
        static_cast<void>(city.sights().store(placeKeyOf(city, probe), sight));
        return cachedRem(city, probe);
    }
    return nullptr;
}

std::size_t keepRems(const PreparedCity& city, const std::vector<Probe>& probes,
                     std::vector<RemSet::Pointer>& maps, const JobContext& job) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < probes.size() && !job.cancelled(); ++i) {
        if (!maps[i] && (maps[i] = keptRem(city, probes[i], job)))
            ++kept;
    }
    return kept;
}

namespace {

Result<ReferenceEnvironmentMap> drawnMap(const PreparedCity& city, const Probe& probe,
                                         const JobContext& job) {
    const auto scene = city.scene(job);
    if (!scene)
        return tl::unexpected(scene.error());
    const glm::dvec3 position = city.inFrame(probe.position);
    const BakeSettings settings = bakeSettingsOf(city.project(), probe);
    if (auto may = checkBaking(**scene, &city.heightfield(), probe.id, position, settings); !may)
        return tl::unexpected(may.error());
    return drawReferenceMap(city, probe.id, position, settings, job);
}

/// Traces the map, and stores what it depends on.
Result<ReferenceEnvironmentMap> tracedMap(const PreparedCity& city, const Probe& probe,
                                          const JobContext& job) {
    const auto scene = city.scene(job);
    if (!scene)
        return tl::unexpected(scene.error());
    const glm::dvec3 position = city.inFrame(probe.position);
    const auto contents = contentsAround(city, job);
    if (!contents)
        return tl::unexpected(contents.error());
    SightRecorder sight(**contents, position, city.lighting());
    auto map = bakeEnvironmentMap(**scene, &city.heightfield(), probe.id, position,
                                  bakeSettingsOf(city.project(), probe), job, &sight);
    if (!map)
        return tl::unexpected(map.error());
    // Without its sight a map is baked again when the city changes: no reason to fail.
    SeenSpace seen = sight.seen();
    const std::uint64_t content = contentOf(seen, **contents);
    static_cast<void>(city.sights().store(placeKeyOf(city, probe),
                                          {probeKey(city, probe), std::move(seen), content}));
    return map;
}

}  // namespace

Result<RemSet::Pointer> bakeProbe(const PreparedCity& city, const Probe& probe,
                                  const JobContext& job, Baker baker) {
    const auto map =
        baker == Baker::Rays ? tracedMap(city, probe, job) : drawnMap(city, probe, job);
    if (!map)
        return tl::unexpected(map.error());
    const std::string key = probeKey(city, probe, baker);
    if (auto stored = city.cache().store(key, *map); !stored)
        return tl::unexpected(stored.error());
    // Read again, so that a fresh and a reused map are the same bits.
    if (auto cached = cachedRem(city, probe, baker))
        return cached;
    return fail(ErrorCode::WriteFailed, "a map that was just stored cannot be read again",
                city.cache().pathOf(key).string(), "Check the disk that the project lies on.");
}

Result<BakeReport> bakeProbes(const PreparedCity& city, const BakeOptions& options,
                              const JobContext& job) {
    const auto probes = chosenProbes(city.project(), options);
    if (!probes)
        return tl::unexpected(probes.error());
    BakeReport report;
    if (auto maps = gatherMaps(city, *probes, options.baker, report, job); !maps)
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
    auto maps = gatherMaps(city, city.project().probes, std::nullopt, report, job);
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
