// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <vector>

namespace reflet {

/// The parts of a city: triangles of one object that hang together by common corners. All vectors
/// have an entry for each triangle. Size is the square root of the product of the two largest
/// edges of the part's box: seen from d metres away, with f pixels per radian, the part covers at
/// most (f·size/d)² pixels. Triangles with corners that do not exist have size 0.
struct CityParts {
    std::vector<float> size;          ///< metres
    std::vector<std::uint32_t> part;  ///< equal for triangles of one part
    std::vector<glm::vec3> center;    ///< of the part's box
};
[[nodiscard]] CityParts cityParts(const CityModel& city);
/// Their sizes alone.
[[nodiscard]] std::vector<float> partSizes(const CityModel& city);

}  // namespace reflet
