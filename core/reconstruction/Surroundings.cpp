// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/Surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr std::size_t kRays = 96;
const double kLowest = std::sin(-5.0 * kPi / 180.0);

/// Evenly on the part of the sphere above kLowest: Fibonacci's spiral.
std::array<glm::dvec3, kRays> makeDirections() {
    std::array<glm::dvec3, kRays> out{};
    const double turn = kPi * (3.0 - std::sqrt(5.0));
    for (std::size_t k = 0; k < kRays; ++k) {
        const double z = kLowest + (1.0 - kLowest) * (double(k) + 0.5) / double(kRays);
        const double r = std::sqrt(1.0 - z * z);
        const double angle = turn * double(k);
        out[k] = {r * std::cos(angle), r * std::sin(angle), z};
    }
    return out;
}

}  // namespace

double nearestSurroundings(const HeightfieldTracer& tracer, const glm::dvec3& position,
                           double most) {
    static const std::array<glm::dvec3, kRays> directions = makeDirections();
    std::array<double, kRays> t{};
    tracer.traceFrom(position, directions, {t, {}});
    return std::min(most, *std::min_element(t.begin(), t.end()));
}

}  // namespace reflet
