// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/geo/ProjectFrame.h"

#include <glm/common.hpp>

namespace reflet {

/// A position of the CRS in the frame, rounded to a micrometre: a northing of 5 800 000 m takes
/// nine digits of a double's sixteen, and a city must not look different for where it lies.
[[nodiscard]] inline glm::dvec3 frameFromAbsolute(const ProjectFrame& frame,
                                                  const glm::dvec3& absolute) {
    return glm::round((absolute - frame.origin) * 1e6) / 1e6;
}

}  // namespace reflet
