// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoveragePlan.h"
#include "core/base/Diagnostic.h"
#include "core/coverage/CoverageFigures.h"
#include "core/coverage/Placement.h"

#include <optional>
#include <string>
#include <vector>

namespace reflet {

struct SuggestOptions : CoverageOptions {
    /// What ends it: a coverage, a number of new probes, or whichever comes first.
    std::optional<double> coverage;
    std::optional<std::size_t> count;
    std::size_t most = 500;  ///< new probes, whatever is asked for
    double leastGain = 0.0;  ///< of a probe, as a share of all; else it is not worth it
    double spacing = 5.0;    ///< metres between candidates along the routes (or over the ground)
    /// Leaves out the project's own probes, but for locked ones: as if nothing had been placed.
    bool afresh = false;
    bool baselines = true;    ///< work out what even spacing, junctions and chance would reach
    bool certificate = true;  ///< work out the bounds
};

/// A place for a new probe, with its reason.
struct SuggestedProbe {
    std::string id;                   ///< free in the project
    glm::dvec3 position{0.0};         ///< absolute
    double gain = 0.0;                ///< of what is asked for, when it is added to those before it
    double coverage = 0.0;            ///< with it and those before it
    std::vector<std::string> routes;  ///< ids of those that it serves, the most served first
    std::string reason;               ///< for people, a sentence
};

/// A probe of the project that would do better elsewhere.
struct ProbeMove {
    std::string id;
    glm::dvec3 to{0.0};  ///< absolute
    double gain = 0.0;   ///< coverage
};

struct Suggestion {
    std::vector<SuggestedProbe> probes;
    bool reached = false;           ///< what was asked for
    Estimate before, after;         ///< coverage, on samples of their own
    double shown = 0.0;             ///< after, by the reconstruction's own choice
    double worst = 0.0, p05 = 0.0;  ///< after, of stretches of the routes

    /// f of all probes (kSecondShare) on the samples that were optimised, and what no other set of
    /// as many new probes among the candidates can exceed; the same for the coverage alone.
    double worth = 0.0, worthBound = 1.0;
    double optimised = 0.0, coverageBound = 1.0;
    Certificate certificate;  ///< of the worth
    [[nodiscard]] double ratio() const { return worthBound > 0.0 ? worth / worthBound : 1.0; }
    /// No fewer new probes among the candidates reach the same coverage; as many as there are where
    /// a number was asked for.
    std::size_t fewest = 0;

    /// Coverage that as many probes as there are now would reach, placed otherwise; and how many an
    /// even spacing needs for the same coverage. nullopt: not worked out, or no such places.
    struct Baselines {
        std::optional<double> uniform, junctions, random;
        std::size_t junctionCount = 0;
        std::optional<std::size_t> uniformCount;
    } baselines;

    /// Of the project's probes: the three moves that help most, each with those before it done.
    std::vector<ProbeMove> moves;
    std::size_t candidates = 0, samples = 0;
    std::vector<Diagnostic> remarks;  ///< candidates that were left out, and why
    double seconds = 0.0;
};

/// Suggests probes for what the routes ask for. What the project has is counted in and left where
/// it is; places inside of its circles without probes are not considered. When the job is
/// cancelled: Cancelled. Usage when neither a coverage nor a count is asked for, or out of range.
[[nodiscard]] Result<Suggestion> suggestProbes(const PreparedCity& city,
                                               const SuggestOptions& options,
                                               const JobContext& job);

/// The project with the probes of a suggestion, all of them or those with these ids.
[[nodiscard]] Project withSuggested(Project project, const Suggestion& suggestion,
                                    const std::vector<std::string>& only = {});

}  // namespace reflet
