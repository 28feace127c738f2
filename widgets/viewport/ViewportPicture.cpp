// SPDX-License-Identifier: GPL-3.0-or-later
// The viewport's OpenGL: it only copies what a frame source has finished.
#include "core/gpu/base/GlVersion.h"
#include "widgets/viewport/ViewportImpl.h"
#include "widgets/viewport/frames/HeadlessFrames.h"
#include "widgets/viewport/frames/InPlaceFrames.h"
#include "widgets/viewport/frames/ThreadedFrames.h"

#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

// What is seen before the first picture: a clear sky, not a black hole.
constexpr std::array<float, 3> kSky{0.62F, 0.74F, 0.88F};
constexpr int kLossesAtMost = 3;        // within kLossWindow: then it is not worth trying
constexpr qint64 kLossWindow = 10'000;  // milliseconds

Error noContext() {
    return {ErrorCode::ResourceLimit,
            "this machine's graphics driver gives no OpenGL context",
            {},
            "Reflet needs OpenGL 4.5: update the graphics driver, or start Reflet with "
            "LIBGL_ALWAYS_SOFTWARE=1 in the environment to draw in software",
            {}};
}

Error lostTooOften() {
    return {ErrorCode::ResourceLimit,
            "the graphics driver gave up several times in a row",
            {},
            "save the project; start Reflet again, with LIBGL_ALWAYS_SOFTWARE=1 in the environment "
            "to draw in software if it goes on",
            {}};
}

}  // namespace

QSize Viewport::Impl::deviceSize() const {
    const double ratio = q.devicePixelRatioF();
    return {std::max(1, int(std::lround(q.width() * ratio))),
            std::max(1, int(std::lround(q.height() * ratio)))};
}

std::unique_ptr<FrameSource> Viewport::Impl::makeSource() const {
    QOpenGLContext* context = q.context();
    Drawing where = drawing;
    if (where == Drawing::Automatic) {
        const auto* name = context->functions()->glGetString(GL_RENDERER);
        const QByteArray renderer(reinterpret_cast<const char*>(name));
        where = renderer.contains("llvmpipe") || renderer.contains("softpipe") ? Drawing::Headless
                                                                               : Drawing::Threaded;
    }
    if (where == Drawing::Headless) {
        return std::make_unique<HeadlessFrames>();
    }
    if (where == Drawing::Threaded && QOpenGLContext::supportsThreadedOpenGL()) {
        return std::make_unique<ThreadedFrames>(context);
    }
    return std::make_unique<InPlaceFrames>();
}

void Viewport::Impl::startDrawing() {
    QOpenGLContext* context = q.context();
    contextGoes = connect(context, &QOpenGLContext::aboutToBeDestroyed, &q, [this] {
        q.makeCurrent();
        stopDrawing();
        q.doneCurrent();
    });
    if (const Result<void> sound = requireOpenGl45(); !sound) {
        showProblem(sound.error());
        return;
    }
    problem->hide();
    context->extraFunctions()->glGenFramebuffers(1, &readFramebuffer);
    source = makeSource();
    connect(source.get(), &FrameSource::frameReady, &q, qOverload<>(&QWidget::update));
    connect(
        source.get(), &FrameSource::failed, &q, [this](const Error& error) { showProblem(error); },
        Qt::QueuedConnection);
    connect(
        source.get(), &FrameSource::contextLost, &q, [this] { contextLost(); },
        Qt::QueuedConnection);
    announced = 0;
    post(true);
}

void Viewport::Impl::stopDrawing() {
    disconnect(contextGoes);
    source.reset();
    shown.reset();
    if (readFramebuffer != 0) {
        q.context()->extraFunctions()->glDeleteFramebuffers(1, &readFramebuffer);
        q.context()->functions()->glDeleteTextures(1, &uploadTexture);
        readFramebuffer = uploadTexture = 0;
        uploaded = 0;
    }
}

void Viewport::Impl::contextLost() {
    losses = lastLoss.isValid() && lastLoss.elapsed() < kLossWindow ? losses + 1 : 1;
    lastLoss.start();
    q.makeCurrent();
    stopDrawing();
    if (losses <= kLossesAtMost) {
        // All content is still on this side: the new source gets it with its first state.
        startDrawing();
    } else {
        showProblem(lostTooOften());
    }
    q.doneCurrent();
    q.update();
}

void Viewport::Impl::showProblem(const Error& error) {
    const QString what = QString::fromStdString(error.what).toHtmlEscaped();
    const QString remedy = QString::fromStdString(error.remedy).toHtmlEscaped();
    problem->setText(QStringLiteral("<p><b>%1</b></p><p>%2</p><p>%3</p>")
                         .arg(tr("The city cannot be drawn here."), what, remedy));
    problem->setAccessibleName(QString::fromStdString(error.message()));
    problem->setGeometry(q.rect());
    problem->show();
    problem->raise();
    QMetaObject::invokeMethod(
        &q, [this, error] { Q_EMIT q.graphicsProblem(error); }, Qt::QueuedConnection);
}

void Viewport::Impl::takeFrame() {
    if (!source) {
        return;
    }
    const std::optional<DrawnFrame> frame = source->acquire();
    if (!frame) {
        return;
    }
    shown = frame;
    if (frame->number != announced) {
        announced = frame->number;
        // Not from within painting: who listens may change the widget.
        QMetaObject::invokeMethod(
            &q, [this, drawn = *frame] { announce(drawn); }, Qt::QueuedConnection);
    }
}

void Viewport::Impl::announce(const DrawnFrame& frame) {
    if (state.playing) {
        placeReflectors(frame.seconds);
        Q_EMIT q.timeChanged(frame.seconds);
    }
    updateHud();
    if (!state.followed.empty()) {
        Q_EMIT q.cameraChanged();
    }
    Q_EMIT q.frameDrawn(frame.statistics, frame.framesPerSecond);
    if (frame.settled) {
        Q_EMIT q.pictureSettled();
    }
}

void Viewport::Impl::bindForReading(const DrawnFrame& frame) {
    QOpenGLExtraFunctions& gl = *q.context()->extraFunctions();
    if (frame.pixels != nullptr && uploaded != frame.number) {
        if (uploadTexture == 0) {
            gl.glGenTextures(1, &uploadTexture);
        }
        gl.glBindTexture(GL_TEXTURE_2D, uploadTexture);
        gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, frame.width, frame.height, 0, GL_RGBA,
                        GL_UNSIGNED_BYTE, frame.pixels);
        gl.glBindTexture(GL_TEXTURE_2D, 0);
        uploaded = frame.number;
    }
    gl.glBindFramebuffer(GL_READ_FRAMEBUFFER, readFramebuffer);
    gl.glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                              frame.pixels != nullptr ? uploadTexture : frame.texture, 0);
}

void Viewport::Impl::copyToWidget(const DrawnFrame& frame) {
    QOpenGLExtraFunctions& gl = *q.context()->extraFunctions();
    const QSize size = deviceSize();
    bindForReading(frame);
    gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER, q.defaultFramebufferObject());
    gl.glDisable(GL_SCISSOR_TEST);
    const bool sameSize = frame.width == size.width() && frame.height == size.height();
    gl.glBlitFramebuffer(0, 0, frame.width, frame.height, 0, 0, size.width(), size.height(),
                         GL_COLOR_BUFFER_BIT, sameSize ? GL_NEAREST : GL_LINEAR);
    // The texture goes to another thread again; it must not stay attached here.
    gl.glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, q.defaultFramebufferObject());
    // Opaque, whatever the renderer left in alpha.
    gl.glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
    gl.glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    gl.glClear(GL_COLOR_BUFFER_BIT);
    gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    source->released();
}

// ---- The widget

Viewport::~Viewport() {
    m_impl->motion.stop();
    if (context() != nullptr) {
        makeCurrent();
        m_impl->stopDrawing();
        doneCurrent();
    }
}

void Viewport::initializeGL() {
    if (m_impl->source) {
        m_impl->stopDrawing();
    }
    m_impl->startDrawing();
}

void Viewport::paintGL() {
    m_impl->takeFrame();
    if (m_impl->source && m_impl->shown) {
        // Drawing in place leaves its own framebuffer bound.
        m_impl->copyToWidget(*m_impl->shown);
        return;
    }
    QOpenGLFunctions& gl = *context()->functions();
    gl.glBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
    gl.glClearColor(kSky[0], kSky[1], kSky[2], 1.0F);
    gl.glClear(GL_COLOR_BUFFER_BIT);
}

void Viewport::resizeEvent(QResizeEvent* event) {
    QOpenGLWidget::resizeEvent(event);
    const QSize size = m_impl->deviceSize();
    m_impl->state.width = size.width();
    m_impl->state.height = size.height();
    m_impl->hud->layOut();
    m_impl->wipeBar->layOut();
    m_impl->problem->setGeometry(rect());
    m_impl->updateHud();
    m_impl->post(true);
}

void Viewport::showEvent(QShowEvent* event) {
    QOpenGLWidget::showEvent(event);
    const QSize size = m_impl->deviceSize();
    m_impl->state.width = size.width();
    m_impl->state.height = size.height();
    m_impl->state.visible = true;
    m_impl->post(true);
    // A widget that got no context is never asked to paint: it must be seen from outside.
    QTimer::singleShot(0, this, [this] {
        if (isVisible() && !isValid()) {
            m_impl->showProblem(noContext());
        }
    });
}

void Viewport::hideEvent(QHideEvent* event) {
    m_impl->endPress(true);
    m_impl->state.visible = false;
    m_impl->post(false);
    QOpenGLWidget::hideEvent(event);
}

QImage Viewport::grabPicture() {
    Impl& d = *m_impl;
    if (!d.source) {
        return {};
    }
    makeCurrent();
    d.takeFrame();
    QImage picture;
    if (d.shown) {
        QOpenGLExtraFunctions& gl = *context()->extraFunctions();
        picture = QImage(d.shown->width, d.shown->height, QImage::Format_RGBX8888);
        d.bindForReading(*d.shown);
        gl.glPixelStorei(GL_PACK_ALIGNMENT, 4);
        gl.glReadPixels(0, 0, picture.width(), picture.height(), GL_RGBA, GL_UNSIGNED_BYTE,
                        picture.bits());
        gl.glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
        gl.glBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
        // OpenGL's rows run from the bottom.
        picture.mirror(false, true);
    }
    doneCurrent();
    return picture;
}

void Viewport::loseContext() {
    if (m_impl->source) {
        m_impl->source->loseContext();
    }
}

}  // namespace reflet
