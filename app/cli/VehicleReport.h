// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/Console.h"
#include "app/pipeline/VehicleFile.h"

#include <string>
#include <vector>

namespace reflet::cli {

/// `info` of glTF files: what is in them, and how Reflet would set them on the road.
[[nodiscard]] int reportVehicles(const std::vector<std::string>& files, const Console& console);

}  // namespace reflet::cli
