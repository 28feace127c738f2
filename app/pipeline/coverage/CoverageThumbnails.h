// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/CoverageReport.h"
#include "core/environment/ImageMetrics.h"

namespace reflet {

struct ThumbnailOptions {
    std::string vehicle;            ///< where none drives the route; "" = "tram"
    int width = 480, height = 270;  ///< pixels of a picture
    int samplesPerEdge = 2;
};

/// A sheet with a row for each of the worst places: street, metres and coverage, below them the
/// vehicle there with the reflections of the probes, beside it the ray-traced reference, from the
/// pavement. Usage when the report has no worst places (on the ground); Refused when a probe is not
/// baked, or where the system has no font.
[[nodiscard]] Result<DisplayImage> worstPlaces(const CoverageReport& report,
                                               const PreparedCity& city,
                                               const ThumbnailOptions& options,
                                               const JobContext& job);

}  // namespace reflet
