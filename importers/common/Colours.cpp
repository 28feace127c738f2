// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/Colours.h"

#include <algorithm>
#include <cmath>

namespace reflet::importers {

glm::vec3 linearFromSrgb(const glm::dvec3& srgb) {
    const auto linear = [](double value) {
        const double v = std::clamp(value, 0.0, 1.0);
        return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    };
    return {linear(srgb.x), linear(srgb.y), linear(srgb.z)};
}

}  // namespace reflet::importers
