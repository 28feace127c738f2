// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/frames/FrameDirector.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kRest{140};      // without a change before a movement counts as over
constexpr milliseconds kLongRest{400};  // before the dear last picture
constexpr milliseconds kShortestFrame{15};
constexpr double kPause = 500.0;  // ms between pictures from which on there was no pace
constexpr double kSmoothing = 0.15;
constexpr int kFineSamples = 2;

double inMilliseconds(FrameDirector::Clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace

void FrameDirector::update(const SceneState& state, Clock::time_point now) {
    if (!m_started || state.clock != m_clock) {
        m_seconds = state.seconds;
        m_secondsSince = now;
        m_playing = state.playing;
        m_speed = state.speed;
        m_clock = state.clock;
    }
    const double duration = state.traffic ? state.traffic->duration() : 0.0;
    if (duration != m_duration) {
        m_seconds = secondsAt(now);
        m_secondsSince = now;
        m_duration = duration;
    }
    const bool moved = !m_started || state.motion != m_motion;
    if (moved || state.touch != m_touch) {
        m_moving = moved || (m_moving && m_stage == Stage::Moving && now - m_lastChange < kRest);
        m_stage = Stage::Outdated;
        m_lastChange = now;
    }
    m_motion = state.motion;
    m_touch = state.touch;
    m_visible = state.visible && state.width > 0 && state.height > 0;
    m_scale.setTarget(state.framesPerSecond);
    m_started = true;
}

bool FrameDirector::driving() const {
    return m_playing && m_duration > 0.0;
}

double FrameDirector::secondsAt(Clock::time_point now) const {
    if (!m_playing) {
        return m_seconds;
    }
    const double seconds = m_seconds + m_speed * inMilliseconds(now - m_secondsSince) / 1000.0;
    return driving() ? std::fmod(seconds, m_duration) : m_seconds;
}

FrameDirector::Stage FrameDirector::nextStage() const {
    if (driving()) {
        return Stage::Moving;
    }
    switch (m_stage) {
        case Stage::Outdated:
            return m_moving ? Stage::Moving : Stage::Full;
        case Stage::Moving:
            return Stage::Full;
        case Stage::Full:
        case Stage::Settled:
            break;
    }
    return Stage::Settled;
}

FrameDirector::Clock::time_point FrameDirector::dueTime(Stage stage) const {
    const Clock::time_point paced = m_lastStart + kShortestFrame;
    switch (stage) {
        case Stage::Settled:
            return std::max(paced, m_lastChange + kLongRest);
        case Stage::Full:
            return m_stage == Stage::Outdated ? paced : std::max(paced, m_lastChange + kRest);
        case Stage::Moving:
        case Stage::Outdated:
            break;
    }
    return paced;
}

FramePlan FrameDirector::planFor(Stage stage, Clock::time_point now) const {
    const double seconds = secondsAt(now);
    switch (stage) {
        case Stage::Settled:
            return {seconds, 1.0, kFineSamples, true};
        case Stage::Full:
            return {seconds, 1.0, 1, false};
        case Stage::Moving:
        case Stage::Outdated:
            break;
    }
    return {seconds, m_scale.scale(), 1, false, true};
}

std::optional<FramePlan> FrameDirector::due(Clock::time_point now) const {
    const std::optional<Clock::time_point> next = nextDue();
    return next && now >= *next ? std::optional(planFor(nextStage(), now)) : std::nullopt;
}

std::optional<FrameDirector::Clock::time_point> FrameDirector::nextDue() const {
    const bool finished = m_stage == Stage::Settled && !driving();
    if (!m_started || !m_visible || finished) {
        return std::nullopt;
    }
    return dueTime(nextStage());
}

void FrameDirector::drawn(const FramePlan& plan, Clock::time_point started, Clock::time_point now) {
    const double cost = inMilliseconds(now - started);
    const Stage stage = nextStage();
    if (stage == Stage::Moving) {
        m_scale.took(cost, plan.scale);
    }
    const double interval = inMilliseconds(now - m_lastFrame);
    if (stage == Stage::Moving && interval > 0.0 && interval < kPause && m_framesPerSecond > 0.0) {
        m_framesPerSecond += kSmoothing * (1000.0 / interval - m_framesPerSecond);
    } else if (stage == Stage::Moving || m_framesPerSecond == 0.0) {
        m_framesPerSecond = 1000.0 / std::max(cost, inMilliseconds(kShortestFrame));
    }
    m_stage = stage;
    m_lastStart = started;
    m_lastFrame = now;
}

}  // namespace reflet
