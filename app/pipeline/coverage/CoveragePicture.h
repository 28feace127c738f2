// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoverageReport.h"
#include "core/coverage/CoverageColor.h"
#include "core/environment/ImageMetrics.h"

namespace reflet {

/// A plan of the city, north up, shaded in grey, with the coverage of the routes (or of the ground)
/// in coverageColor() and in numbers, the probes, the worst places by their rank, and a legend:
/// title, ramp, scale bar, arrow to grid north. Refused where the system has no font.
[[nodiscard]] Result<DisplayImage> coveragePicture(const CoverageReport& report,
                                                   const PreparedCity& city);

}  // namespace reflet
