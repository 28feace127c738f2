// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeDirection.h"
#include "core/heightfield/HeightfieldTracer.h"

namespace reflet {

/// The directions of a face at all (s, t) of two lists, exactly those of faceDirection(): columns
/// by s, rows by t. For HeightfieldTracer::traceGrid(). The lists must outlive it.
[[nodiscard]] inline DirectionGrid faceDirections(int face, std::span<const double> s,
                                                  std::span<const double> t) {
    const glm::dvec3 base = faceDirection(face, {0.0, 0.0});
    return {base, faceDirection(face, {1.0, 0.0}) - base, faceDirection(face, {0.0, 1.0}) - base, s,
            t};
}

}  // namespace reflet
