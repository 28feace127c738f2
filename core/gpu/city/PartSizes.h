// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <vector>

namespace reflet {

/// For each triangle the size in metres of the part that it belongs to: triangles of one object
/// that hang together by common corners. Size is the square root of the product of the two largest
/// edges of the part's box: seen from d metres away, with f pixels per radian, the part covers at
/// most (f·size/d)² pixels. Triangles with corners that do not exist have size 0.
[[nodiscard]] std::vector<float> partSizes(const CityModel& city);

}  // namespace reflet
