// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoverageReport.h"
#include "app/pipeline/coverage/Suggest.h"

#include <nlohmann/json.hpp>

namespace reflet {

/// What `coverage --json` prints (docs/manual/command-line.md): coverage{}, routes[], worst[],
/// facades{}, objects[], probes[], crs, on, samples, seconds. Shares are 0..1; what the ground has
/// not (worst, p05, largestGap) is null.
[[nodiscard]] nlohmann::json coverageJson(const CoverageReport& report, const Project& project);

/// What `suggest --json` prints: probes[], coverage{}, certificate{}, baselines{}, moves[], crs,
/// reached, candidates, samples, remarks[], seconds.
[[nodiscard]] nlohmann::json suggestionJson(const Suggestion& suggestion, const Project& project);

/// One sentence for people: "9 new probes reach 96.1 %; no 9 could exceed 98.3 %."
[[nodiscard]] std::string certificateSentence(const Suggestion& suggestion);

}  // namespace reflet
