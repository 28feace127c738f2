// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoverageReport.h"
#include "core/environment/ImageMetrics.h"

namespace reflet {

/// A share of 0..1 as a colour that people with any colour vision can order: dark blue over green
/// to yellow, ever lighter. Display values.
[[nodiscard]] glm::vec3 coverageColor(double share);

/// A plan of the city, north up, shaded in grey, with the coverage of the routes (or of the ground)
/// in coverageColor() and in numbers, the probes, the worst places by their rank, and a legend:
/// title, ramp, scale bar, arrow to grid north. Refused where the system has no font.
[[nodiscard]] Result<DisplayImage> coveragePicture(const CoverageReport& report,
                                                   const PreparedCity& city);

}  // namespace reflet
