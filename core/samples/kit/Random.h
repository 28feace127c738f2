// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

namespace reflet::kit {

/// Random numbers that are the same on every machine: the standard fixes the engine's output but
/// not that of its distributions, so those are written out here.
class Random {
public:
    explicit Random(std::uint64_t seed) : m_engine(seed) {}

    /// In [0, 1), from 53 random bits.
    double unit() { return double(m_engine() >> 11U) * 0x1.0p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// From low to high, both included; low <= high.
    int integer(int low, int high) { return low + int(unit() * double(high - low + 1)); }
    bool chance(double probability) { return unit() < probability; }
    template <class T, std::size_t N>
    const T& pick(const std::array<T, N>& choices) {
        return choices[std::size_t(unit() * double(N))];
    }
    /// A stream of its own for a part of the city, so that a change in one part leaves the rest.
    Random fork(std::uint64_t salt) { return Random(m_engine() ^ (salt * 0x9e3779b97f4a7c15ULL)); }

private:
    std::mt19937_64 m_engine;
};

}  // namespace reflet::kit
