// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"

#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// How a probe is baked: the project's settings with its own resolution.
[[nodiscard]] BakeSettings bakeSettingsOf(const Project& project, const Probe& probe);
/// Cache key of the map that the probe should have now.
[[nodiscard]] std::string probeKey(const PreparedCity& city, const Probe& probe,
                                   Baker baker = Baker::Rays);
/// The map of the probe as it should be now, when the cache holds it; else null. Of both bakers'
/// that of rays is taken; with a baker, only its own.
[[nodiscard]] RemSet::Pointer cachedRem(const PreparedCity& city, const Probe& probe,
                                        std::optional<Baker> baker = std::nullopt);
/// The same for many, read in parallel.
[[nodiscard]] std::vector<RemSet::Pointer> cachedRems(const PreparedCity& city,
                                                      const std::vector<Probe>& probes,
                                                      const JobContext& job,
                                                      std::optional<Baker> baker = std::nullopt);
/// What the probe's traced map depends on, when the cache holds both; else nullopt.
[[nodiscard]] std::optional<Sight> sightOf(const PreparedCity& city, const Probe& probe);
/// A map that was traced of the city as it was before, where nothing that it depends on has changed
/// since: then it is what baking would give, and is stored as such. Null when there is none.
[[nodiscard]] RemSet::Pointer keptRem(const PreparedCity& city, const Probe& probe,
                                      const JobContext& job);
/// Looks for kept maps where `maps` (one per probe) has none. How many were found.
std::size_t keepRems(const PreparedCity& city, const std::vector<Probe>& probes,
                     std::vector<RemSet::Pointer>& maps, const JobContext& job);
/// Bakes the probe and stores the map. Refused inside solids and below ground, with the nearest
/// free place as the remedy. ResourceLimit where OpenGL is to draw it and there is none.
[[nodiscard]] Result<RemSet::Pointer> bakeProbe(const PreparedCity& city, const Probe& probe,
                                                const JobContext& job, Baker baker = Baker::Rays);

struct BakeOptions {
    std::vector<std::string> only;  ///< ids of probes; empty = all
    int shardIndex = 1;             ///< 1..shardCount: this process bakes every shardCount-th probe
    int shardCount = 1;
    Baker baker = Baker::Rays;
};

struct BakeReport {
    std::size_t probes = 0;  ///< of this shard
    std::size_t baked = 0;
    std::size_t reused = 0;  ///< found in the cache
    std::size_t kept = 0;    ///< of the city as it was: they see nothing of what has changed
    double seconds = 0.0;
    double raysPerSecond = 0.0;        ///< primary rays of the baked maps
    std::size_t bytes = 0;             ///< of all maps of this shard on disk
    std::vector<Diagnostic> failures;  ///< probes that were refused, with the reason
};

/// Bakes the probes that the cache does not hold and stores them. A probe that cannot be baked
/// (inside a solid) is reported and does not stop the others. Usage for an unknown id or shard.
[[nodiscard]] Result<BakeReport> bakeProbes(const PreparedCity& city, const BakeOptions& options,
                                            const JobContext& job);

/// All REMs of the project, baked where the cache lacks them, read from the cache so that a fresh
/// and a reused map are the same bits. Probes that are refused are left out and reported.
struct LoadedRems {
    RemSet rems;
    std::vector<Diagnostic> failures;
};
[[nodiscard]] Result<LoadedRems> loadRems(const PreparedCity& city, const JobContext& job);

}  // namespace reflet
