// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace reflet {

/// Finalizer of SplitMix64 (Steele, Lea, Flood 2014): numbers that add up without patterns.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

/// Of two in this order.
[[nodiscard]] constexpr std::uint64_t joined(std::uint64_t a, std::uint64_t b) {
    return mixed(a ^ mixed(b));
}

}  // namespace reflet
