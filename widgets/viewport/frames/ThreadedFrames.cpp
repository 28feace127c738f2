// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/frames/ThreadedFrames.h"

#include "widgets/viewport/frames/FrameSlots.h"
#include "widgets/viewport/frames/SceneDrawer.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLFramebufferObject>
#include <QThread>
#include <array>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>

namespace reflet {

namespace {

constexpr GLenum kContextLost = 0x0507;         // GL_CONTEXT_LOST, of OpenGL 4.5
constexpr GLuint64 kLongestWait = 200'000'000;  // ns for the interface's copy of a picture
constexpr int kErrorsAtMost = 16;               // a lost context may report errors without end

Error internalError(const char* what) {
    return {ErrorCode::Internal,
            std::string("the picture could not be drawn: ") + what,
            {},
            "save the project and start Reflet again",
            {}};
}

}  // namespace

class ThreadedFrames::Worker : public QThread {
public:
    explicit Worker(ThreadedFrames& owner, QOpenGLContext* shareWith) : m_owner(owner) {
        m_surface.setFormat(shareWith->format());
        m_surface.create();
        m_context = std::make_unique<QOpenGLContext>();
        m_context->setFormat(shareWith->format());
        m_context->setShareContext(shareWith);
        m_usable = m_context->create() && m_surface.isValid();
        m_context->moveToThread(this);
    }

    void post(const SceneState& state) {
        {
            const std::lock_guard lock(m_mutex);
            m_posted = state;
            m_hasPosted = true;
        }
        m_wake.notify_one();
    }
    void stop() {
        {
            const std::lock_guard lock(m_mutex);
            m_stop = true;
        }
        m_wake.notify_one();
        wait();
    }
    void loseContext() {
        {
            const std::lock_guard lock(m_mutex);
            m_lose = true;
        }
        m_wake.notify_one();
    }

    FrameSlots m_slots;
    std::size_t m_shownPlace = 0;
    /// Set by the thread that shows, when its copy of a picture is on its way.
    std::array<std::atomic<GLsync>, FrameSlots::kCount> m_copied{};

protected:
    void run() override {
        if (!m_usable || !m_context->makeCurrent(&m_surface)) {
            Q_EMIT m_owner.contextLost();
            m_context.reset();
            return;
        }
        try {
            drawUntilStopped();
        } catch (const std::exception& error) {
            Q_EMIT m_owner.failed(internalError(error.what()));
        }
        for (std::size_t place = 0; place < FrameSlots::kCount; ++place) {
            waitForCopy(*m_context->extraFunctions(), place);
        }
        m_targets = {};
        m_context->doneCurrent();
        m_context.reset();
    }

private:
    enum class Outcome { Stopped, Lost };

    void drawUntilStopped() {
        Result<std::unique_ptr<SceneDrawer>> drawer = SceneDrawer::create();
        if (!drawer) {
            Q_EMIT m_owner.failed(drawer.error());
            return;
        }
        if (loop(**drawer) == Outcome::Lost) {
            Q_EMIT m_owner.contextLost();
        }
        // The renderer's objects are deleted while the context is still current.
        drawer->reset();
    }

    Outcome loop(SceneDrawer& drawer) {
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

    /// Sleeps until there is a new state or something is due; false when it is time to go.
    bool waitForWork() {
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

    /// False when the context is gone.
    bool drawOne(SceneDrawer& drawer, const FramePlan& plan,
                 FrameDirector::Clock::time_point started) {
        QOpenGLExtraFunctions& gl = *m_context->extraFunctions();
        const std::size_t place = m_slots.drawing();
        waitForCopy(gl, place);
        const auto [width, height] = SceneDrawer::sizeOf(m_state, plan);
        std::unique_ptr<QOpenGLFramebufferObject>& target = m_targets[place];
        if (!target || target->size() != QSize(width, height)) {
            target.reset();
            target = std::make_unique<QOpenGLFramebufferObject>(
                width, height, QOpenGLFramebufferObject::NoAttachment, GL_TEXTURE_2D, GL_RGBA8);
        }
        DrawnFrame frame = drawer.draw(m_state, plan, target->handle());
        gl.glFinish();
        if (lost(gl)) {
            return false;
        }
        m_director.drawn(plan, started, FrameDirector::Clock::now());
        frame.texture = target->texture();
        frame.number = ++m_number;
        frame.framesPerSecond = m_director.framesPerSecond();
        if (m_slots.publish(frame)) {
            Q_EMIT m_owner.frameReady();
        }
        return true;
    }

    void waitForCopy(QOpenGLExtraFunctions& gl, std::size_t place) {
        if (GLsync copied = m_copied[place].exchange(nullptr)) {
            gl.glClientWaitSync(copied, 0, kLongestWait);
            gl.glDeleteSync(copied);
        }
    }

    bool lost(QOpenGLExtraFunctions& gl) const {
        for (int k = 0; k < kErrorsAtMost; ++k) {
            const GLenum error = gl.glGetError();
            if (error == kContextLost) {
                return true;
            }
            if (error == GL_NO_ERROR) {
                return !m_context->isValid();
            }
        }
        return true;
    }

    ThreadedFrames& m_owner;
    QOffscreenSurface m_surface;
    std::unique_ptr<QOpenGLContext> m_context;
    bool m_usable = false;

    std::mutex m_mutex;
    std::condition_variable m_wake;
    SceneState m_posted;
    bool m_hasPosted = false, m_stop = false, m_lose = false;

    // Of the thread alone.
    bool m_lost = false;
    SceneState m_state;
    FrameDirector m_director;
    std::uint64_t m_number = 0;
    std::array<std::unique_ptr<QOpenGLFramebufferObject>, FrameSlots::kCount> m_targets;
};

ThreadedFrames::ThreadedFrames(QOpenGLContext* shareWith, QObject* parent)
    : FrameSource(parent), m_worker(std::make_unique<Worker>(*this, shareWith)) {
    m_worker->setObjectName(QStringLiteral("reflet viewport"));
    m_worker->start();
}

ThreadedFrames::~ThreadedFrames() {
    m_worker->stop();
}

void ThreadedFrames::post(const SceneState& state) {
    m_worker->post(state);
}

std::optional<DrawnFrame> ThreadedFrames::acquire() {
    return m_worker->m_slots.take(m_worker->m_shownPlace);
}

void ThreadedFrames::released() {
    QOpenGLExtraFunctions& gl = *QOpenGLContext::currentContext()->extraFunctions();
    const GLsync now = gl.glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (GLsync before = m_worker->m_copied[m_worker->m_shownPlace].exchange(now)) {
        gl.glDeleteSync(before);
    }
}

void ThreadedFrames::loseContext() {
    m_worker->loseContext();
}

}  // namespace reflet
