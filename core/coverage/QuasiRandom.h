// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace reflet {

/// Points of the unit cube that cover it evenly, however many are taken: the additive recurrence
/// with the generalised golden ratio (Roberts 2018, "The unreasonable effectiveness of quasirandom
/// sequences"): x_k = frac(shift_k + n / φ^(k+1)), φ the root above 1 of φ^(D+1) = φ + 1. Several
/// runs with independent shifts are independent estimates, whose spread tells the error.
template <std::size_t D>
class QuasiRandom {
public:
    using Point = std::array<double, D>;

    explicit QuasiRandom(std::uint64_t seed = 0) {
        double phi = 1.5;
        for (int i = 0; i < 60; ++i)  // a fixed point that contracts
            phi = std::pow(1.0 + phi, 1.0 / double(D + 1));
        double step = 1.0;
        for (std::size_t k = 0; k < D; ++k) {
            step /= phi;
            m_step[k] = step;
            m_shift[k] = uniform(seed, k);
        }
    }

    [[nodiscard]] Point at(std::uint64_t n) const {
        Point point;
        for (std::size_t k = 0; k < D; ++k) {
            const double x = m_shift[k] + double(n) * m_step[k];
            point[k] = x - std::floor(x);
        }
        return point;
    }

private:
    /// In [0, 1): the mixing function of SplitMix64 (Steele, Lea, Flood 2014).
    static double uniform(std::uint64_t seed, std::uint64_t k) {
        std::uint64_t z = seed * 0x9E3779B97F4A7C15ULL + (k + 1) * 0xD1B54A32D192ED03ULL;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        z ^= z >> 31U;
        return double(z >> 11U) * 0x1.0p-53;
    }

    Point m_step{}, m_shift{};
};

}  // namespace reflet
