// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/heightfield/HeightfieldTracer.h"

#include <cstddef>

namespace reflet {

/// Whether `t` (+infinity: a miss) is what traceReference finds in the columns of the field's
/// centres, bit for bit.
[[nodiscard]] bool isOracles(const Heightfield& field, const Ray& ray, double t);

/// How many of so many random rays are not traced as the oracle does, by the tracer of the field's
/// centres: hit, cell and ray parameter, bit for bit. From anywhere in and around the field, above,
/// inside and below its columns; a part of them along axes, along borders and through corners of
/// cells, or level at the height of a column. The rays are the same each time.
[[nodiscard]] std::size_t randomMismatches(const HeightfieldTracer& tracer,
                                           const Heightfield& field, std::size_t rays,
                                           const JobContext& job);

}  // namespace reflet
