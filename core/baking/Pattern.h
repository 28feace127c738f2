// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace reflet {

/// Nothing finer than this is drawn, metres: below it, positions are rounding noise.
inline constexpr float kFinest = 2e-3F;

/// The cone that a sample looks through where it meets a surface. Patterns are averaged over it, so
/// that a wall far away has its mean colour and nothing flickers.
struct Footprint {
    glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< of the sample's ray, unit
    float width = 0.0F;                      ///< across the ray at the surface, metres

    /// Extent along the unit axis `a` of a plane with unit normal n. A ray turned by a small δ ⟂ d
    /// meets the plane at t·(δ − d (δ·n)/(d·n)), so the coordinate a·p moves by
    /// t·δ·(a − n (d·a)/(d·n)), whose vector has the length √(1 + ((d·a)/(d·n))²).
    [[nodiscard]] float along(const glm::vec3& a, const glm::vec3& n) const {
        const float facing = std::max(std::abs(glm::dot(direction, n)), 0.02F);
        const float slant = glm::dot(direction, a) / facing;
        return std::max(width * std::sqrt(1.0F + slant * slant), kFinest);
    }
};

/// A well-mixed hash of up to three integers (the finaliser of MurmurHash3).
[[nodiscard]] inline std::uint32_t patternHash(std::uint32_t seed, std::int32_t x = 0,
                                               std::int32_t y = 0) {
    std::uint32_t h =
        seed + 0x9e3779b9U * std::uint32_t(x) + 0x85ebca6bU * (std::uint32_t(y) ^ 0x27d4eb2fU);
    h = (h ^ (h >> 16)) * 0x85ebca6bU;
    h = (h ^ (h >> 13)) * 0xc2b2ae35U;
    return h ^ (h >> 16);
}
/// The same as a number in [0, 1).
[[nodiscard]] inline float patternRandom(std::uint32_t seed, std::int32_t x = 0,
                                         std::int32_t y = 0) {
    return float(patternHash(seed, x, y) >> 8) * (1.0F / 16777216.0F);
}

/// Smooth noise in [-1, 1] on a unit lattice, bilinear with eased weights.
[[nodiscard]] inline float valueNoise(float x, float y, std::uint32_t seed) {
    const float fx = std::floor(x);
    const float fy = std::floor(y);
    const auto ease = [](float t) { return t * t * (3.0F - 2.0F * t); };
    const float u = ease(x - fx);
    const float v = ease(y - fy);
    const auto i = std::int32_t(fx);
    const auto j = std::int32_t(fy);
    const float south = glm::mix(patternRandom(seed, i, j), patternRandom(seed, i + 1, j), u);
    const float north =
        glm::mix(patternRandom(seed, i, j + 1), patternRandom(seed, i + 1, j + 1), u);
    return 2.0F * glm::mix(south, north, v) - 1.0F;
}

/// What is left of a detail of this size seen through a footprint: 1 when it is resolved, 0 when
/// only its mean remains.
[[nodiscard]] inline float resolved(float detail, float footprint) {
    const float t = std::clamp((footprint / detail - 0.35F) / 0.9F, 0.0F, 1.0F);
    return 1.0F - t * t * (3.0F - 2.0F * t);
}

/// Noise of a wavelength in metres that fades to its mean (0) with the footprint.
[[nodiscard]] inline float filteredNoise(float x, float y, float wavelength, float footprint,
                                         std::uint32_t seed) {
    const float strength = resolved(wavelength, footprint);
    return strength > 0.0F ? strength * valueNoise(x / wavelength, y / wavelength, seed) : 0.0F;
}

/// The share of the interval of width w around x that lies in [from, to]: a box filter.
[[nodiscard]] inline float intervalCoverage(float x, float from, float to, float w) {
    const float low = std::max(x - 0.5F * w, from);
    const float high = std::min(x + 0.5F * w, to);
    return std::clamp((high - low) / w, 0.0F, 1.0F);
}

/// The same for an interval repeated with a period, in cells first..last (last not included):
/// exact for any w, from the integral of the pulse train.
[[nodiscard]] inline float periodicCoverage(float x, float period, float from, float to, float w,
                                            float first = -1e6F, float last = 1e6F) {
    // Counted from the cell at hand: differences of large integrals would be noise.
    const float base = std::floor(x / period);
    const float within = x - base * period;
    const auto integral = [&](float at) {
        const float cells = std::clamp(at / period, first - base, last - base);
        const float cell = std::floor(cells);
        return cell * (to - from) + std::clamp((cells - cell) * period - from, 0.0F, to - from);
    };
    return std::clamp((integral(within + 0.5F * w) - integral(within - 0.5F * w)) / w, 0.0F, 1.0F);
}

/// Linear Rec. 709 from an sRGB code as designers write it, 0xRRGGBB.
[[nodiscard]] glm::vec3 colourOf(std::uint32_t srgb);
/// Linear values of the 256 sRGB codes (IEC 61966-2-1).
[[nodiscard]] const std::array<float, 256>& linearFromSrgbTable();

}  // namespace reflet
