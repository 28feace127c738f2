// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoverageReport.h"
#include "app/pipeline/coverage/CoverageWatch.h"
#include "app/pipeline/coverage/Suggest.h"
#include "core/gpu/overlay/CoverageOverlay.h"
#include "widgets/coverage/CoveragePanel.h"

#include <memory>
#include <optional>
#include <vector>

// What the window makes of a coverage: figures for the panel and shapes for the views. Values from
// values, to be called on any thread.

namespace reflet {

/// Samples of a coverage that is followed while probes are moved: known to about 0.5 %.
inline constexpr std::size_t kFollowedSamples = std::size_t{1} << 15U;
/// Façades that are drawn; of more, those that are mirrored most.
inline constexpr std::size_t kMostSpots = 6000;
/// Metres from a spot within which a place for a probe is looked for.
inline constexpr double kNearby = 30.0;

struct ShownCoverage {
    CoverageFacts facts;
    CoverageOverlay overlay;  ///< without suggested probes
};

struct MeasuredCoverage {
    ShownCoverage shown;
    std::shared_ptr<CoverageWatch> watch;  ///< follows the project's probes
};

/// The whole report, and a watch that goes on from there. Cancelled.
[[nodiscard]] Result<MeasuredCoverage> measureCoverage(std::shared_ptr<const PreparedCity> city,
                                                       const JobContext& job);

/// What the watch knows of the probes that it follows.
[[nodiscard]] ShownCoverage shownCoverage(const CoverageWatch& watch,
                                          const std::vector<Probe>& probes);

/// The sentences of a suggestion's card, and the moves that help.
[[nodiscard]] SuggestionFacts factsOf(const Suggestion& suggestion);

/// The place on the routes (on the ground, where there is none) within kNearby of a spot where one
/// more probe adds most; nullopt where none adds anything. The id is empty. Project frame for the
/// spot. Cancelled.
[[nodiscard]] Result<std::optional<SuggestedProbe>> suggestNear(const CoverageWatch& watch,
                                                                const PreparedCity& city,
                                                                const glm::dvec3& spot,
                                                                const JobContext& job);

}  // namespace reflet
