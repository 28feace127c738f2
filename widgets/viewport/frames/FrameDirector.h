// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/AdaptiveScale.h"
#include "widgets/viewport/frames/SceneState.h"

#include <chrono>
#include <optional>

namespace reflet {

/// What to draw next.
struct FramePlan {
    double seconds = 0.0;  ///< of the drive
    double scale = 1.0;    ///< edge of the picture as a share of the full size
    int samplesPerEdge = 1;
    bool settled = false;  ///< nothing is left to refine after it
    bool moving = false;   ///< one of a movement: drawn fast rather than fine
};

/// Decides when which picture is drawn, how large, and at what time of the drive. While something
/// moves, pictures follow one another at the size that keeps the pace; when it rests, one at full
/// size and then one with 2 × 2 samples a pixel. Changes in one go are shown at full size at once.
/// Knows no OpenGL and no clock but the one that it is told.
class FrameDirector {
public:
    using Clock = std::chrono::steady_clock;

    /// Takes the newest state; equal revisions change nothing.
    void update(const SceneState& state, Clock::time_point now);
    /// The picture that is due now; none: nothing to do before nextDue().
    [[nodiscard]] std::optional<FramePlan> due(Clock::time_point now) const;
    /// When something will be due if no new state comes; none: never.
    [[nodiscard]] std::optional<Clock::time_point> nextDue() const;
    /// Tells that the picture was drawn, from `started` to `now`.
    void drawn(const FramePlan& plan, Clock::time_point started, Clock::time_point now);

    /// Pictures a second: the pace while something moves, else what the last one would allow.
    [[nodiscard]] double framesPerSecond() const { return m_framesPerSecond; }

private:
    enum class Stage { Outdated, Moving, Full, Settled };

    [[nodiscard]] bool driving() const;
    [[nodiscard]] double secondsAt(Clock::time_point now) const;
    [[nodiscard]] FramePlan planFor(Stage stage, Clock::time_point now) const;
    [[nodiscard]] Clock::time_point dueTime(Stage stage) const;
    [[nodiscard]] Stage nextStage() const;

    AdaptiveScale m_scale;
    Stage m_stage = Stage::Outdated;  ///< of the newest picture
    bool m_moving = true;             ///< the last change was part of a movement
    bool m_playing = false;           ///< wanted; it drives once there is a drive
    double m_speed = 1.0;
    bool m_visible = false;
    bool m_started = false;  ///< any state has come
    double m_seconds = 0.0;
    double m_duration = 0.0;
    Clock::time_point m_secondsSince, m_lastChange, m_lastStart, m_lastFrame;
    std::uint64_t m_clock = 0, m_motion = 0, m_touch = 0;
    double m_framesPerSecond = 0.0;
};

}  // namespace reflet
