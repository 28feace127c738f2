// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>

namespace reflet {

/// A double as the sum of two floats: `high` is the nearest float, `low` the nearest float to what
/// is left. high + low, taken in double, differs from the value by at most 2^-48 of its magnitude,
/// half a nanometre at the northing of a city. |value| must be below the largest float.
struct HighLow {
    float high = 0.0F;
    float low = 0.0F;
};

/// The same for each component of a position.
struct HighLow3 {
    glm::vec3 high{0.0F};
    glm::vec3 low{0.0F};
};

[[nodiscard]] inline HighLow splitFloat(double value) {
    // g++ 12 at -O2 and above drops the rounding in double -> float -> double where its vectoriser
    // pairs neighbouring components, and `low` becomes 0. A volatile read makes the rounding
    // happen; -ffp-contract=off, -frounding-math and a detour over std::bit_cast don't.
    const volatile float rounded = static_cast<float>(value);
    const float high = rounded;
    return {high, static_cast<float>(value - static_cast<double>(high))};
}

[[nodiscard]] inline HighLow3 splitFloat(const glm::dvec3& position) {
    const HighLow x = splitFloat(position.x);
    const HighLow y = splitFloat(position.y);
    const HighLow z = splitFloat(position.z);
    return {{x.high, y.high, z.high}, {x.low, y.low, z.low}};
}

}  // namespace reflet
