// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/heightfield/HeightRules.h"
#include "core/heightfield/Heightfield.h"

namespace reflet {

/// Finds the columns of a finished heightfield that are hollow somewhere, and what is solid in
/// them. Columns without ground are left as they are. The same bits for any order of triangles and
/// any number of threads. Memory: beside the result a bit a cell, and 16 bytes for each triangle
/// over each such column, 64 MB at a time. Internal to core/heightfield.
[[nodiscard]] Result<void> addSpans(Heightfield& field, const CityModel& city,
                                    const HeightRules& rules, const JobContext& job);

}  // namespace reflet
