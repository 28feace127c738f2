// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/viewport/frames/FrameSlots.h"
#include "widgets/viewport/frames/FrameSource.h"
#include "widgets/viewport/frames/SceneDrawer.h"

#include <QThread>
#include <atomic>
#include <condition_variable>
#include <mutex>

namespace reflet {

/// The thread that draws pictures: takes the newest state, asks the director what is due, draws it
/// and publishes it. What kind of OpenGL context it draws in is up to who derives from it.
class FrameWorker : public QThread {
    Q_OBJECT
public:
    explicit FrameWorker(FrameSource& owner) : m_owner(owner) {}

    void post(const SceneState& state);
    /// Ends the thread after the picture that is being drawn, and waits for it. To be called before
    /// destruction.
    void stop();
    void loseContext();
    [[nodiscard]] FrameSlots& pictures() { return m_pictures; }
    /// Number of the newest picture that is finished.
    [[nodiscard]] std::uint64_t finished() const { return m_number; }

protected:
    // All of these are called on the thread.
    /// False: there is no context.
    [[nodiscard]] virtual bool beginDrawing() = 0;
    /// Frees what was made, context included.
    virtual void endDrawing() = 0;
    /// The framebuffer of a place, with this size.
    [[nodiscard]] virtual unsigned target(std::size_t place, int width, int height) = 0;
    /// Waits until the picture is complete and says where it is. False: the context is lost.
    [[nodiscard]] virtual bool finish(std::size_t place, DrawnFrame& frame) = 0;

    void run() override;

private:
    enum class Outcome { Stopped, Lost };
    void drawUntilStopped();
    [[nodiscard]] Outcome loop(SceneDrawer& drawer);
    /// Sleeps until there is a new state or something is due; false when it is time to go.
    [[nodiscard]] bool waitForWork();
    /// False when the context is gone.
    [[nodiscard]] bool drawOne(SceneDrawer& drawer, const FramePlan& plan,
                               FrameDirector::Clock::time_point started);

    FrameSource& m_owner;
    FrameSlots m_pictures;

    std::mutex m_mutex;
    std::condition_variable m_wake;
    SceneState m_posted;
    bool m_hasPosted = false, m_stop = false, m_lose = false;

    // Of the thread alone.
    bool m_lost = false;
    SceneState m_state;
    FrameDirector m_director;

    std::atomic<std::uint64_t> m_number = 0;  ///< written by the thread
};

}  // namespace reflet
