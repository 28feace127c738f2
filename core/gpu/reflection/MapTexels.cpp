// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/MapTexels.h"

#include "core/base/ParallelFor.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace reflet {

namespace {

constexpr float kLargestHalf = 65504.0F;
constexpr std::size_t kFaces = 6, kChannels = 4;
constexpr std::uint16_t kSign = 0x8000;

/// halfOf() in a form that compilers make vectors of: no branches, and inlined.
inline std::uint16_t toHalf(float value) {
    constexpr std::uint32_t kInfinityBits = 0x7f800000U;
    constexpr std::uint32_t kTooLarge = 0x47800000U;     // 65536
    constexpr std::uint32_t kLeastNormal = 0x38800000U;  // 2^-14
    constexpr std::uint32_t kHalf = 0x3f000000U;         // 0.5
    constexpr std::uint32_t kRebias = 112U << 23U;       // exponents start at 127 and at 15
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t size = bits & 0x7fffffffU;
    // 13 bits of the mantissa go: just below half of the last that stays is added, and one more
    // where that is odd.
    const std::uint32_t normal = (size + 0xfffU + ((size >> 13U) & 1U) - kRebias) >> 13U;
    // Beside 0.5 a float's last bit is worth 2^-24, as that of a subnormal half: the sum rounds.
    const std::uint32_t subnormal =
        std::bit_cast<std::uint32_t>(std::bit_cast<float>(size) + 0.5F) - kHalf;
    std::uint32_t half = size < kLeastNormal ? subnormal : normal;
    half = size >= kTooLarge ? 0x7c00U : half;
    half = size > kInfinityBits ? 0x7e00U : half;
    return std::uint16_t(half | ((bits >> 16U) & kSign));
}

void toHalves(const float* values, std::size_t count, std::uint16_t* halves) {
    for (std::size_t i = 0; i < count; ++i)
        halves[i] = toHalf(values[i]);
}

/// A face of `edge` texels becomes one of half as many along an edge, in place: a mean is written
/// where all that comes before it has been read.
void halve(float* texels, std::size_t edge) {
    const std::size_t line = kChannels * edge;
    float* to = texels;
    for (std::size_t row = 0; row < edge; row += 2) {
        const float* upper = texels + row * line;
        const float* lower = upper + line;
        for (std::size_t i = 0; i < line; i += 2 * kChannels, to += kChannels) {
            float mean[kChannels];
            for (std::size_t c = 0; c < kChannels; ++c)
                mean[c] = 0.25F * ((upper[i + c] + upper[i + kChannels + c]) +
                                   (lower[i + c] + lower[i + kChannels + c]));
            std::copy_n(mean, kChannels, to);
        }
    }
}

std::size_t halvesOf(int edge) {
    return kFaces * kChannels * std::size_t(edge) * std::size_t(edge);
}

}  // namespace

std::uint16_t halfOf(float value) {
    return toHalf(value);
}

std::size_t MapTexels::offset(int level) const {
    std::size_t sum = 0;
    for (int i = 0; i < level; ++i)
        sum += halvesOf(resolution >> i);
    return sum;
}

MapTexels mapTexels(const CubeMap<glm::vec3>& radiance, const CubeMap<float>& distance,
                    const CubeMap<unsigned char>& uncovered, MapLevels levels) {
    const int n = radiance.resolution();
    assert(distance.resolution() == n && (uncovered.empty() || uncovered.resolution() == n));
    MapTexels out;
    out.resolution = n;
    const bool all = levels == MapLevels::All && n > 0 && std::has_single_bit(unsigned(n));
    out.levels = all ? std::bit_width(unsigned(n)) : 1;
    out.halves.resize(out.offset(out.levels));
    const auto texels = std::size_t(n) * std::size_t(n);
    parallelFor(0, kFaces, 1, [&](std::size_t first, std::size_t last) {
        std::vector<float> face(kChannels * texels);
        for (std::size_t f = first; f < last; ++f) {
            const glm::vec3* colour = radiance.texels().data() + f * texels;
            const float* away = distance.texels().data() + f * texels;
            for (std::size_t i = 0; i < texels; ++i) {
                for (int c = 0; c < 3; ++c)
                    face[kChannels * i + std::size_t(c)] = std::min(colour[i][c], kLargestHalf);
                face[kChannels * i + 3] = away[i];
            }
            for (int level = 0; level < out.levels; ++level) {
                const auto edge = std::size_t(n >> level);
                const std::size_t count = kChannels * edge * edge;
                toHalves(face.data(), count, &out.halves[out.offset(level) + f * count]);
                if (level + 1 < out.levels)
                    halve(face.data(), edge);
            }
            for (std::size_t i = 0; i < (uncovered.empty() ? 0 : texels); ++i) {
                if (uncovered.texels()[f * texels + i] != 0)
                    out.halves[kChannels * (f * texels + i) + 3] |= kSign;
            }
        }
    });
    return out;
}

}  // namespace reflet
