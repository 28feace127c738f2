// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"
#include "core/heightfield/HeightfieldTracer.h"

namespace reflet {

/// Where rays from a position through the centres of all texels of a cube map hit: the parameters
/// of rays whose directions are scaled to 1 along the face's axis, +infinity where they miss. In
/// parallel.
[[nodiscard]] CubeMap<double> traceTexels(const HeightfieldTracer& tracer,
                                          const glm::dvec3& position, int resolution);

}  // namespace reflet
