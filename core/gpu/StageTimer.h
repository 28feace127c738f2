// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Stopwatch.h"
#include "core/gpu/base/GlObjects.h"

#include <algorithm>
#include <optional>

namespace reflet {

/// What a stage of a frame costs, from the wall time of its calls and from what the GPU took for
/// them: the GPU works on while the calls have returned (software rendering in other threads), and
/// tells some frames later. Without OpenGL.
class StageCost {
public:
    /// The calls of a frame took so long, milliseconds. measured: the GPU is going to tell of them.
    /// Returns what the stage cost: the calls, and how much longer the GPU took than they at last
    /// count. A frame that was slow for its calls (a shader that is compiled when it is first used)
    /// is so once, not again when the GPU tells of the same.
    double took(double calls, bool measured) {
        if (measured)
            m_measured = calls;
        return calls + m_longer;
    }
    /// The GPU took so long for the measured frame, whose stage began `ago` before now: it cannot
    /// have taken longer. (Of its first frame Mesa's llvmpipe says that it took half an hour.)
    void told(double gpu, double ago) { m_longer = std::max(0.0, std::min(gpu, ago) - m_measured); }

private:
    double m_measured = 0.0;  ///< the calls of the frame that the GPU tells of
    double m_longer = 0.0;
};

/// Measures a StageCost. Never waits.
class StageTimer {
public:
    void begin() {
        if (!m_query)
            m_query = TimerQuery::make();
        if (const auto gpu = m_query.take())
            m_cost.told(*gpu, kMilliseconds * m_measured.seconds());
        m_measures = m_query.begin();
        m_calls = Stopwatch();
        if (m_measures)
            m_measured = m_calls;
    }
    /// Milliseconds.
    double end() {
        m_query.end();
        return m_cost.took(kMilliseconds * m_calls.seconds(), m_measures);
    }

private:
    static constexpr double kMilliseconds = 1e3;
    TimerQuery m_query;
    StageCost m_cost;
    Stopwatch m_calls, m_measured;
    bool m_measures = false;
};

}  // namespace reflet
