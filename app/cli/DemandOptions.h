// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/Arguments.h"
#include "app/pipeline/coverage/CoveragePlan.h"

namespace reflet::cli {

/// What `coverage` and `suggest` share, from the command line into the pipeline's options.
inline void take(const DemandArguments& arguments, CoverageOptions& options) {
    if (!arguments.on.empty())
        options.on = arguments.on == "ground" ? DemandOn::Ground : DemandOn::Routes;
    options.vehicle = arguments.vehicle;
    options.seed = arguments.seed;
    options.error = arguments.error;
}

}  // namespace reflet::cli
