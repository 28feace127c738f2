// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/Bc6h.h"
#include "core/environment/Bc6hForms.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {

using namespace bc6h;

namespace {

constexpr std::size_t kTexels = 16;
constexpr float kLargestHalf = 65504.0f;
constexpr float kWidenedPerHalf = 64.0f / 31.0f;
constexpr int kFits = 3;  // of a line to its texels
constexpr float kLargestWidened = 65535.0f;

using Channels = std::array<float, 3>;
/// Of all texels, a channel after the other.
using Planar = std::array<std::array<float, kTexels>, 3>;

/// The bit pattern of a half float, with what lies between two of them.
double halfBits(float value) {
    if (!(value > 0.0f))
        return 0.0;
    const double clipped = double(std::min(value, kLargestHalf));
    int exponent = 0;
    const double mantissa = std::frexp(clipped, &exponent);  // [0.5, 1)
    if (exponent < -13)
        return std::ldexp(clipped, 24);  // below 2^-14: steps of 2^-24
    return 1024.0 * (double(exponent + 13) + 2.0 * mantissa);
}

/// A line of colours in the space of half floats' bit patterns, widened to 16 bits.
struct Line {
    Channels first{}, second{};
};

struct Choice {
    Form form = kForms[0];
    Parts parts;
    float error = std::numeric_limits<float>::infinity();
};

/// One block on its way: what its texels should be and how much their errors show.
class BlockEncoder {
public:
    explicit BlockEncoder(const Bc6hTexels& texels) {
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < kTexels; ++i) {
                const float value = texels[i][int(c)];
                const double bits = halfBits(value);
                m_half[c][i] = float(bits);
                m_nearest[c][i] = int(std::nearbyint(bits));
                // A display shows about x^(1/2.4): a step of a half's bits, which is a part of x,
                // changes it by as much again times x^(1/2.4). Squared, of what a half may hold.
                const float bounded = value > 0.0f ? std::min(value, kLargestHalf) : 0.0f;
                m_weight[c][i] = std::pow(bounded, 2.0f / 2.4f) + kLeastWeight;
            }
        }
    }

    [[nodiscard]] Bc6hBlock encode() const;

private:
    static constexpr float kLeastWeight = 1e-4f;

    [[nodiscard]] bool isOneColour() const;
    [[nodiscard]] Choice oneColour() const;
    [[nodiscard]] Line principalLine() const;
    /// The steps that err least of a palette of half bits, and the error.
    float choose(const Planar& palette, std::array<std::uint8_t, kTexels>& steps) const;
    [[nodiscard]] Line fitted(const std::array<std::uint8_t, kTexels>& steps) const;
    void consider(const Form& form, const Line& line, Choice& best) const;
    [[nodiscard]] Choice evaluated(const Form& form, const Parts& parts) const;
    void adjust(Choice& choice) const;
    [[nodiscard]] float errorOf(std::size_t channel, const Choice& choice, int first,
                                int second) const;

    Planar m_half{}, m_weight{};
    std::array<std::array<int, kTexels>, 3> m_nearest{};  ///< bit patterns of half floats
};

Planar paletteOf(const Line& line) {
    Planar palette;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < kTexels; ++k) {
            const float along = float(kSteps[k]) / 64.0f;
            palette[c][k] =
                (line.first[c] + along * (line.second[c] - line.first[c])) / kWidenedPerHalf - 0.5f;
        }
    }
    return palette;
}

Planar paletteOf(const Form& form, const Parts& parts) {
    Planar palette;
    for (std::size_t c = 0; c < 3; ++c) {
        const int first = widened(parts.first[c], form.bits);
        const int second = widened(parts.second[c], form.bits);
        for (std::size_t k = 0; k < kTexels; ++k)
            palette[c][k] = float(halfBitsAt(first, second, kSteps[k]));
    }
    return palette;
}

int quantised(float wide, int bits) {
    const float steps = wide * float(1 << bits) / 65536.0f;
    return std::clamp(int(bits == 16 ? steps + 0.5f : steps), 0, (1 << bits) - 1);
}

/// The first texel's step has three bits: the line is turned round where it needs four.
void turnAsNeeded(Parts& parts) {
    if (parts.steps[0] < 8)
        return;
    std::swap(parts.first, parts.second);
    for (std::uint8_t& step : parts.steps)
        step = std::uint8_t(15 - step);
}

bool BlockEncoder::isOneColour() const {
    return std::all_of(m_nearest.begin(), m_nearest.end(), [](const auto& channel) {
        return std::all_of(channel.begin(), channel.end(),
                           [&](int bits) { return bits == channel[0]; });
    });
}

/// 16 bits a channel tell every half: (x · 31) >> 6 runs through all of them.
Choice BlockEncoder::oneColour() const {
    Choice choice;
    choice.form = kForms[3];
    for (std::size_t c = 0; c < 3; ++c)
        choice.parts.first[c] = choice.parts.second[c] = (m_nearest[c][0] * 64 + 30) / 31;
    return choice;
}

/// Along the direction in which the texels spread most, from the first of them to the last.
Line BlockEncoder::principalLine() const {
    Channels mean{};
    for (std::size_t c = 0; c < 3; ++c) {
        float weight = 0.0f;
        for (std::size_t i = 0; i < kTexels; ++i) {
            mean[c] += m_weight[c][i] * m_half[c][i];
            weight += m_weight[c][i];
        }
        mean[c] /= weight;
    }
    std::array<Channels, 3> spread{};
    for (std::size_t i = 0; i < kTexels; ++i) {
        Channels d;
        for (std::size_t c = 0; c < 3; ++c)
            d[c] = std::sqrt(m_weight[c][i]) * (m_half[c][i] - mean[c]);
        for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c)
                spread[r][c] += d[r] * d[c];
        }
    }
    Channels axis{1.0f, 1.0f, 1.0f};
    for (int turn = 0; turn < 8; ++turn) {
        Channels next{};
        float largest = 0.0f;
        for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c)
                next[r] += spread[r][c] * axis[c];
            largest = std::max(largest, std::abs(next[r]));
        }
        if (!(largest > 0.0f))
            break;  // nothing spreads along what is left
        for (std::size_t c = 0; c < 3; ++c)
            axis[c] = next[c] / largest;
    }
    const float square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
    float from = std::numeric_limits<float>::infinity();
    float to = -from;
    for (std::size_t i = 0; i < kTexels; ++i) {
        float along = 0.0f;
        for (std::size_t c = 0; c < 3; ++c)
            along += axis[c] * (m_half[c][i] - mean[c]) / square;
        from = std::min(from, along);
        to = std::max(to, along);
    }
    Line line;
    const auto wide = [&](std::size_t c, float along) {
        return std::clamp((mean[c] + along * axis[c] + 0.5f) * kWidenedPerHalf, 0.0f,
                          kLargestWidened);
    };
    for (std::size_t c = 0; c < 3; ++c) {
        line.first[c] = wide(c, from);
        line.second[c] = wide(c, to);
    }
    return line;
}

float BlockEncoder::choose(const Planar& palette, std::array<std::uint8_t, kTexels>& steps) const {
    float sum = 0.0f;
    for (std::size_t i = 0; i < kTexels; ++i) {
        std::array<float, kTexels> errors{};
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t k = 0; k < kTexels; ++k) {
                const float d = palette[c][k] - m_half[c][i];
                errors[k] += m_weight[c][i] * d * d;
            }
        }
        const auto best = std::min_element(errors.begin(), errors.end());
        steps[i] = std::uint8_t(best - errors.begin());
        sum += *best;
    }
    return sum;
}

/// The line that errs least with given steps: least squares, each channel by itself.
Line BlockEncoder::fitted(const std::array<std::uint8_t, kTexels>& steps) const {
    Line line;
    for (std::size_t c = 0; c < 3; ++c) {
        float aa = 0.0f, ab = 0.0f, bb = 0.0f, at = 0.0f, bt = 0.0f;
        for (std::size_t i = 0; i < kTexels; ++i) {
            const float b = float(kSteps[steps[i]]) / 64.0f;
            const float a = 1.0f - b;
            const float wide = (m_half[c][i] + 0.5f) * kWidenedPerHalf;
            aa += m_weight[c][i] * a * a;
            ab += m_weight[c][i] * a * b;
            bb += m_weight[c][i] * b * b;
            at += m_weight[c][i] * a * wide;
            bt += m_weight[c][i] * b * wide;
        }
        const float determinant = aa * bb - ab * ab;
        if (determinant > 1e-6f * (aa + bb) * (aa + bb)) {
            line.first[c] = (at * bb - bt * ab) / determinant;
            line.second[c] = (bt * aa - at * ab) / determinant;
        } else {
            line.first[c] = line.second[c] = (at + bt) / (aa + 2.0f * ab + bb);
        }
        line.first[c] = std::clamp(line.first[c], 0.0f, kLargestWidened);
        line.second[c] = std::clamp(line.second[c], 0.0f, kLargestWidened);
    }
    return line;
}

Choice BlockEncoder::evaluated(const Form& form, const Parts& parts) const {
    Choice choice{form, parts, 0.0f};
    choice.error = choose(paletteOf(form, parts), choice.parts.steps);
    return choice;
}

void BlockEncoder::consider(const Form& form, const Line& line, Choice& best) const {
    Parts parts;
    for (std::size_t c = 0; c < 3; ++c) {
        parts.first[c] = quantised(line.first[c], form.bits);
        parts.second[c] = quantised(line.second[c], form.bits);
    }
    if (!fits(form, parts))
        return;
    Choice choice = evaluated(form, parts);
    if (choice.error < best.error)
        best = choice;
}

float BlockEncoder::errorOf(std::size_t channel, const Choice& choice, int first,
                            int second) const {
    std::array<float, kTexels> palette;
    const int a = widened(first, choice.form.bits);
    const int b = widened(second, choice.form.bits);
    for (std::size_t k = 0; k < kTexels; ++k)
        palette[k] = float(halfBitsAt(a, b, kSteps[k]));
    float sum = 0.0f;
    for (std::size_t i = 0; i < kTexels; ++i) {
        const float d = palette[choice.parts.steps[i]] - m_half[channel][i];
        sum += m_weight[channel][i] * d * d;
    }
    return sum;
}

/// Quantised ends a step up or down, while that helps.
void BlockEncoder::adjust(Choice& choice) const {
    const int most = (1 << choice.form.bits) - 1;
    Parts parts = choice.parts;
    for (std::size_t c = 0; c < 3; ++c) {
        float least = errorOf(c, choice, parts.first[c], parts.second[c]);
        const Parts before = parts;
        for (int i = -1; i <= 1; ++i) {
            for (int j = -1; j <= 1; ++j) {
                Parts tried = parts;
                tried.first[c] = std::clamp(before.first[c] + i, 0, most);
                tried.second[c] = std::clamp(before.second[c] + j, 0, most);
                const float error = errorOf(c, choice, tried.first[c], tried.second[c]);
                if (error < least && fits(choice.form, tried)) {
                    least = error;
                    parts = tried;
                }
            }
        }
    }
    const Choice adjusted = evaluated(choice.form, parts);
    if (adjusted.error < choice.error)
        choice = adjusted;
}

Bc6hBlock BlockEncoder::encode() const {
    if (isOneColour()) {
        const Choice choice = oneColour();
        return pack(choice.form, choice.parts);
    }
    Choice best;
    Line line = principalLine();
    for (int fit = 0; fit <= kFits; ++fit) {
        std::array<std::uint8_t, kTexels> steps{};
        choose(paletteOf(line), steps);
        line = fitted(steps);
    }
    for (const Form& form : kForms)
        consider(form, line, best);
    // Once more, for the steps that the quantised ends led to.
    const Form form = best.form;
    consider(form, fitted(best.parts.steps), best);
    adjust(best);
    turnAsNeeded(best.parts);
    return pack(best.form, best.parts);
}

}  // namespace

Bc6hBlock encodeBc6h(const Bc6hTexels& texels) {
    return BlockEncoder(texels).encode();
}

}  // namespace reflet
