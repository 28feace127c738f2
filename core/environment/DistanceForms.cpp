// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/DistanceForms.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace reflet::distance_forms {

namespace {

constexpr unsigned kFloatMantissa = 23;
constexpr unsigned kLeastExponent = 107;  // of a float: 2^-20
constexpr float kPlaneSlopes = float(1 << 19);
constexpr float kRoughSlopes = 384.0f;
constexpr unsigned kPlaneMantissa = 17;
constexpr unsigned kRoughMantissa = 7;

std::uint64_t slope(float value, float steps, unsigned bits) {
    const auto limit = float(1 << (bits - 1U));
    const int step = int(std::clamp(std::round(value * steps), -limit, limit - 1.0f));
    return std::uint64_t(step) & ((1ULL << bits) - 1ULL);
}

}  // namespace

std::uint64_t smallFloat(float value, unsigned mantissa) {
    if (!(value > 0.0f))
        return 0;
    const unsigned dropped = kFloatMantissa - mantissa;
    const std::uint64_t least = std::uint64_t(kLeastExponent) << mantissa;
    const std::uint64_t largest = (1ULL << (mantissa + 5U)) - 1ULL;
    const std::uint64_t rounded =
        (std::uint64_t(std::bit_cast<std::uint32_t>(value)) + (1ULL << (dropped - 1U))) >> dropped;
    return rounded <= least ? 1 : std::min(rounded - least, largest);
}

float fromSmallFloat(unsigned bits, unsigned mantissa) {
    if (bits == 0)
        return 0.0f;
    return std::bit_cast<float>((bits << (kFloatMantissa - mantissa)) +
                                (kLeastExponent << kFloatMantissa));
}

std::uint64_t planeEntry(const Plane& plane) {
    return smallFloat(plane.a, kPlaneMantissa) | (slope(plane.k, kPlaneSlopes, 20) << 22U) |
           (slope(plane.l, kPlaneSlopes, 20) << 42U);
}

Plane planeOf(std::uint64_t entry) {
    return {fromSmallFloat(bitsOf(entry, 0, 22), kPlaneMantissa),
            float(signedBitsOf(entry, 22, 20)) / kPlaneSlopes,
            float(signedBitsOf(entry, 42, 20)) / kPlaneSlopes};
}

std::uint64_t roughBlock(const Plane& plane) {
    return std::uint64_t(Form::Rough) | (smallFloat(plane.a, kRoughMantissa) << 2U) |
           (slope(plane.k, kRoughSlopes, 9) << 14U) | (slope(plane.l, kRoughSlopes, 9) << 23U);
}

Plane roughPlaneOf(std::uint64_t block) {
    return {fromSmallFloat(bitsOf(block, 2, 12), kRoughMantissa),
            float(signedBitsOf(block, 14, 9)) / kRoughSlopes,
            float(signedBitsOf(block, 23, 9)) / kRoughSlopes};
}

}  // namespace reflet::distance_forms
