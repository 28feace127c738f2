// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/frames/FrameWorker.h"

#include <exception>

namespace reflet {

namespace {

Error internalError(const char* what) {
    return {ErrorCode::Internal,
            std::string("the picture could not be drawn: ") + what,
            {},
            "save the project and start Reflet again",
            {}};
}

}  // namespace

void FrameWorker::post(const SceneState& state) {
    {
        const std::lock_guard lock(m_mutex);
        m_posted = state;
        m_hasPosted = true;
    }
    m_wake.notify_one();
}

void FrameWorker::stop() {
    {
        const std::lock_guard lock(m_mutex);
        m_stop = true;
    }
    m_wake.notify_one();
    wait();
}

void FrameWorker::loseContext() {
    {
        const std::lock_guard lock(m_mutex);
        m_lose = true;
    }
    m_wake.notify_one();
}

void FrameWorker::run() {
    if (beginDrawing()) {
        try {
            drawUntilStopped();
        } catch (const std::exception& error) {
            Q_EMIT m_owner.failed(internalError(error.what()));
        }
    } else {
        Q_EMIT m_owner.contextLost();
    }
    endDrawing();
}

void FrameWorker::drawUntilStopped() {
    // The renderer's objects are deleted here, while the context is still current.
    const Result<std::unique_ptr<SceneDrawer>> drawer = SceneDrawer::create();
    if (!drawer) {
        Q_EMIT m_owner.failed(drawer.error());
    } else if (loop(**drawer) == Outcome::Lost) {
        Q_EMIT m_owner.contextLost();
    }
}

FrameWorker::Outcome FrameWorker::loop(SceneDrawer& drawer) {
    while (waitForWork()) {
        if (m_lost) {
            return Outcome::Lost;
        }
        const FrameDirector::Clock::time_point now = FrameDirector::Clock::now();
        m_director.update(m_state, now);
        const std::optional<FramePlan> plan = m_director.due(now);
        if (plan && !drawOne(drawer, *plan, now)) {
            return Outcome::Lost;
        }
    }
    return Outcome::Stopped;
}

bool FrameWorker::waitForWork() {
    std::unique_lock lock(m_mutex);
    const auto woken = [this] { return m_stop || m_lose || m_hasPosted; };
    if (const auto due = m_director.nextDue()) {
        m_wake.wait_until(lock, *due, woken);
    } else {
        m_wake.wait(lock, woken);
    }
    m_lost = m_lose;
    if (m_hasPosted) {
        m_state = m_posted;
        m_hasPosted = false;
    }
    return !m_stop;
}

bool FrameWorker::drawOne(SceneDrawer& drawer, const FramePlan& plan,
                          FrameDirector::Clock::time_point started) {
    const std::size_t place = m_pictures.drawing();
    const auto [width, height] = SceneDrawer::sizeOf(m_state, plan);
    DrawnFrame frame = drawer.draw(m_state, plan, target(place, width, height));
    if (!finish(place, frame)) {
        return false;
    }
    m_director.drawn(plan, started, FrameDirector::Clock::now());
    frame.number = ++m_number;
    frame.framesPerSecond = m_director.framesPerSecond();
    if (m_pictures.publish(frame)) {
        Q_EMIT m_owner.frameReady();
    }
    return true;
}

}  // namespace reflet
