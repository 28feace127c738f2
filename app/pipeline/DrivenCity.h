// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Bake.h"
#include "app/pipeline/Traffic.h"

#include <filesystem>

namespace reflet {

/// A project with its vehicles and its probes' maps, baked where the cache lacks them.
struct DrivenCity {
    PreparedCity city;
    Traffic traffic;
    LoadedRems rems;
};

/// Fails as PreparedCity::open(), trafficOf() and loadRems() do; probes that are refused do not
/// stop it.
[[nodiscard]] Result<DrivenCity> openDriven(const std::filesystem::path& projectFile,
                                            const JobContext& job);

}  // namespace reflet
