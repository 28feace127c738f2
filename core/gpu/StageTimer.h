// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/GlObjects.h"

#include <algorithm>
#include <chrono>

namespace reflet {

/// The cost of one stage of a frame: the wall time of its calls, or the GPU's time of some frames
/// ago where that is longer (software rendering works in other threads). Never waits.
class StageTimer {
public:
    void begin() {
        if (!m_query)
            m_query = TimerQuery::make();
        m_start = std::chrono::steady_clock::now();
        m_query.begin();
    }
    /// Milliseconds.
    double end() {
        m_query.end();
        const std::chrono::duration<double, std::milli> wall =
            std::chrono::steady_clock::now() - m_start;
        return std::max(wall.count(), m_query.milliseconds());
    }
    /// Of these the GPU's, of some frames ago.
    [[nodiscard]] double gpu() { return m_query.milliseconds(); }

private:
    TimerQuery m_query;
    std::chrono::steady_clock::time_point m_start;
};

}  // namespace reflet
