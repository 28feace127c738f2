// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/reconstruction/ValidityChanges.h"

#include <cstddef>
#include <optional>

namespace reflet {

/// What the probes of a project take as graphics cards keep them, and what that does to them.
struct MemoryBenchReport {
    std::size_t maps = 0;
    std::size_t texels = 0;
    std::size_t plainBytes = 0;       ///< as half floats
    std::size_t compressedBytes = 0;  ///< core/environment/CompressedMap
    double milliseconds = 0.0;        ///< of compressing a map, median
    /// Radiance as it shows at the project's exposure: PSNR over all maps, and of the worst one.
    std::optional<double> decibels, worstDecibels;
    double offShare = 0.0;  ///< texels whose distance is off by more than 5 cm and 0.1 %
    ValidityChanges validity;

    [[nodiscard]] double changedTexelShare() const {
        return validity.texels > 0 ? double(validity.changedTexels) / double(validity.texels) : 0.0;
    }
    [[nodiscard]] double changedDecisionShare() const {
        return validity.decisions > 0
                   ? double(validity.changedDecisions) / double(validity.decisions)
                   : 0.0;
    }
};

/// Compresses the probes' maps; decisions are compared in local maps at `positions` places along
/// the routes (1..1000), none where nothing drives. Usage when there are no probes; Cancelled.
[[nodiscard]] Result<MemoryBenchReport> benchMemory(const PreparedCity& city, const RemSet& rems,
                                                    int positions, const JobContext& job);

}  // namespace reflet
