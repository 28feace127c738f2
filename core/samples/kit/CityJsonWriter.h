// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/SampleCity.h"

#include <string>

namespace reflet::kit {

/// Where a sample city stands.
struct SamplePlace {
    std::string referenceSystem;  ///< URL of the CRS; empty = none (local metres)
    glm::dvec3 origin{0.0};       ///< of the city's local metres, in that CRS
};

/// CityJSON 2.0 text: millimetres as integers, semantics, materials by name under the theme
/// "reflet", repeated things as geometry templates. The same city gives the same bytes.
[[nodiscard]] std::string writeCityJson(const SampleCity& city, const SamplePlace& place);

}  // namespace reflet::kit
