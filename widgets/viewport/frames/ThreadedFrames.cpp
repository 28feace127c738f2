// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/frames/ThreadedFrames.h"

#include "widgets/viewport/frames/FrameWorker.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLFramebufferObject>
#include <array>
#include <atomic>

namespace reflet {

namespace {

constexpr GLenum kContextLost = 0x0507;         // GL_CONTEXT_LOST, of OpenGL 4.5
constexpr GLuint64 kLongestWait = 200'000'000;  // ns for the interface's copy of a picture
constexpr int kErrorsAtMost = 16;               // a lost context may report errors without end

}  // namespace

class ThreadedFrames::Worker : public FrameWorker {
public:
    Worker(ThreadedFrames& owner, QOpenGLContext* shareWith) : FrameWorker(owner) {
        m_surface.setFormat(shareWith->format());
        m_surface.create();
        m_context = std::make_unique<QOpenGLContext>();
        m_context->setFormat(shareWith->format());
        m_context->setShareContext(shareWith);
        m_usable = m_context->create() && m_surface.isValid();
        m_context->moveToThread(this);
    }

    std::size_t m_shownPlace = 0;
    /// Set by the thread that shows, when its copy of a picture is on its way.
    std::array<std::atomic<GLsync>, FrameSlots::kCount> m_copied{};

protected:
    bool beginDrawing() override { return m_usable && m_context->makeCurrent(&m_surface); }

    void endDrawing() override {
        if (m_context->makeCurrent(&m_surface)) {
            for (std::size_t place = 0; place < FrameSlots::kCount; ++place) {
                waitForCopy(place);
            }
            m_targets = {};
            m_context->doneCurrent();
        }
        m_context.reset();
    }

    unsigned target(std::size_t place, int width, int height) override {
        waitForCopy(place);
        std::unique_ptr<QOpenGLFramebufferObject>& made = m_targets[place];
        if (!made || made->size() != QSize(width, height)) {
            made.reset();
            made = std::make_unique<QOpenGLFramebufferObject>(
                width, height, QOpenGLFramebufferObject::NoAttachment, GL_TEXTURE_2D, GL_RGBA8);
        }
        return made->handle();
    }

    bool finish(std::size_t place, DrawnFrame& frame) override {
        QOpenGLFunctions& gl = *m_context->functions();
        gl.glFinish();
        frame.texture = m_targets[place]->texture();
        for (int k = 0; k < kErrorsAtMost; ++k) {
            const GLenum error = gl.glGetError();
            if (error == GL_NO_ERROR) {
                return m_context->isValid();
            }
            if (error == kContextLost) {
                break;
            }
        }
        return false;
    }

private:
    void waitForCopy(std::size_t place) {
        if (GLsync copied = m_copied[place].exchange(nullptr)) {
            QOpenGLExtraFunctions& gl = *m_context->extraFunctions();
            gl.glClientWaitSync(copied, 0, kLongestWait);
            gl.glDeleteSync(copied);
        }
    }

    QOffscreenSurface m_surface;
    std::unique_ptr<QOpenGLContext> m_context;
    bool m_usable = false;
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
    return m_worker->pictures().take(m_worker->m_shownPlace);
}

void ThreadedFrames::released() {
    QOpenGLExtraFunctions& gl = *QOpenGLContext::currentContext()->extraFunctions();
    const GLsync now = gl.glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (GLsync before = m_worker->m_copied[m_worker->m_shownPlace].exchange(now)) {
        gl.glDeleteSync(before);
    }
}

std::uint64_t ThreadedFrames::finished() const {
    return m_worker->finished();
}

void ThreadedFrames::loseContext() {
    m_worker->loseContext();
}

}  // namespace reflet
