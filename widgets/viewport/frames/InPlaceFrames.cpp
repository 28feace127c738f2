// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/frames/InPlaceFrames.h"

#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>
#include <algorithm>
#include <chrono>

namespace reflet {

InPlaceFrames::InPlaceFrames(QObject* parent) : FrameSource(parent) {
    m_timer.setSingleShot(true);
    m_timer.setTimerType(Qt::PreciseTimer);
    connect(&m_timer, &QTimer::timeout, this, &FrameSource::frameReady);
}

InPlaceFrames::~InPlaceFrames() = default;

void InPlaceFrames::post(const SceneState& state) {
    m_state = state;
    m_director.update(m_state, FrameDirector::Clock::now());
    schedule();
}

void InPlaceFrames::schedule() {
    const std::optional<FrameDirector::Clock::time_point> due = m_director.nextDue();
    if (!due || m_failed) {
        m_timer.stop();
        return;
    }
    const auto wait =
        std::chrono::ceil<std::chrono::milliseconds>(*due - FrameDirector::Clock::now());
    m_timer.start(std::max(wait, std::chrono::milliseconds(0)));
}

std::optional<DrawnFrame> InPlaceFrames::acquire() {
    const FrameDirector::Clock::time_point now = FrameDirector::Clock::now();
    const std::optional<FramePlan> plan = m_director.due(now);
    if (!plan || m_failed) {
        return m_frame;
    }
    if (!m_drawer) {
        Result<std::unique_ptr<SceneDrawer>> drawer = SceneDrawer::create();
        if (!drawer) {
            m_failed = true;
            Q_EMIT failed(drawer.error());
            return std::nullopt;
        }
        m_drawer = std::move(*drawer);
    }
    const auto [width, height] = SceneDrawer::sizeOf(m_state, *plan);
    if (!m_target || m_target->size() != QSize(width, height)) {
        m_target = std::make_unique<QOpenGLFramebufferObject>(
            width, height, QOpenGLFramebufferObject::NoAttachment, GL_TEXTURE_2D, GL_RGBA8);
    }
    m_frame = m_drawer->draw(m_state, *plan, m_target->handle());
    QOpenGLContext::currentContext()->functions()->glFinish();
    m_director.drawn(*plan, now, FrameDirector::Clock::now());
    m_frame->texture = m_target->texture();
    m_frame->number = ++m_number;
    m_frame->framesPerSecond = m_director.framesPerSecond();
    schedule();
    return m_frame;
}

void InPlaceFrames::loseContext() {
    Q_EMIT contextLost();
}

}  // namespace reflet
