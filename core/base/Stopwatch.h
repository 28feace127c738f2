// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <ctime>

namespace reflet {

/// Seconds since it was made.
class Stopwatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_begun).count();
    }
    /// Processor time of all threads: what a busy machine does not change much.
    [[nodiscard]] double cpuSeconds() const {
        return double(std::clock() - m_busy) / CLOCKS_PER_SEC;
    }

private:
    std::chrono::steady_clock::time_point m_begun = std::chrono::steady_clock::now();
    std::clock_t m_busy = std::clock();
};

}  // namespace reflet
