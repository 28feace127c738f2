// SPDX-License-Identifier: GPL-3.0-or-later
// How finished pictures come from a frame source to the screen.
#include "core/gpu/GlContext.h"
#include "core/gpu/base/GlVersion.h"
#include "widgets/viewport/ViewportImpl.h"
#include "widgets/viewport/frames/HeadlessFrames.h"
#include "widgets/viewport/frames/InPlaceFrames.h"
#include "widgets/viewport/frames/ThreadedFrames.h"

#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QPaintEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet {

namespace {

// What is seen before the first picture: a clear sky, not a black hole.
constexpr QColor kSky(158, 189, 224);
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

/// Looks at the picture's pixels where they are.
QImage pixelsOf(const DrawnFrame& frame) {
    return {reinterpret_cast<const uchar*>(frame.pixels), frame.width, frame.height,
            QImage::Format_RGB32};
}

}  // namespace

QSize Viewport::Impl::deviceSize() const {
    const double ratio = q.devicePixelRatioF();
    return {std::max(1, int(std::lround(q.width() * ratio))),
            std::max(1, int(std::lround(q.height() * ratio)))};
}

void Viewport::Impl::makeCanvas() {
    canvas = new GlCanvas([this] { startOnCanvas(); }, [this] { paintOnCanvas(); }, &q);
    canvas->setGeometry(q.rect());
    canvas->lower();
}

/// The driver turned out to draw in software: its pictures are painted as pixels.
void Viewport::Impl::leaveCanvas() {
    stopDrawing();
    delete std::exchange(canvas, nullptr);
    startDrawing();
    q.update();
}

/// With the canvas's context current where there is a canvas.
void Viewport::Impl::startDrawing() {
    problem->hide();
    if (canvas == nullptr) {
        startSource(std::make_unique<HeadlessFrames>());
        return;
    }
    QOpenGLContext* context = canvas->context();
    contextGoes = connect(context, &QOpenGLContext::aboutToBeDestroyed, &q, [this] {
        canvas->makeCurrent();
        stopDrawing();
        canvas->doneCurrent();
    });
    context->extraFunctions()->glGenFramebuffers(1, &readFramebuffer);
    if (drawing != Drawing::InPlace && QOpenGLContext::supportsThreadedOpenGL()) {
        startSource(std::make_unique<ThreadedFrames>(context));
    } else {
        startSource(std::make_unique<InPlaceFrames>());
    }
}

void Viewport::Impl::startOnCanvas() {
    if (source) {
        stopDrawing();
    }
    if (const Result<void> sound = requireOpenGl45(); !sound) {
        showProblem(sound.error());
        return;
    }
    const auto* name = canvas->context()->functions()->glGetString(GL_RENDERER);
    if (drawing == Drawing::Automatic && isSoftwareRenderer(reinterpret_cast<const char*>(name))) {
        QMetaObject::invokeMethod(
            &q, [this] { leaveCanvas(); }, Qt::QueuedConnection);
        return;
    }
    startDrawing();
}

void Viewport::Impl::startSource(std::unique_ptr<FrameSource> made) {
    source = std::move(made);
    connect(source.get(), &FrameSource::frameReady, &q, [this] { updatePicture(); });
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
        canvas->context()->extraFunctions()->glDeleteFramebuffers(1, &readFramebuffer);
        readFramebuffer = 0;
    }
}

void Viewport::Impl::contextLost() {
    losses = lastLoss.isValid() && lastLoss.elapsed() < kLossWindow ? losses + 1 : 1;
    lastLoss.start();
    if (canvas != nullptr) {
        canvas->makeCurrent();
    }
    stopDrawing();
    if (losses <= kLossesAtMost) {
        // All content is still on this side: the new source gets it with its first state.
        startDrawing();
    } else {
        showProblem(lostTooOften());
    }
    if (canvas != nullptr) {
        canvas->doneCurrent();
    }
    updatePicture();
}

void Viewport::Impl::updatePicture() {
    canvas != nullptr ? canvas->update() : q.update();
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
    Q_EMIT q.pictureShown(frame.number, frame.revision);
    if (frame.settled) {
        Q_EMIT q.pictureSettled();
    }
}

void Viewport::Impl::bindForReading(const DrawnFrame& frame) {
    QOpenGLExtraFunctions& gl = *canvas->context()->extraFunctions();
    gl.glBindFramebuffer(GL_READ_FRAMEBUFFER, readFramebuffer);
    gl.glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                              frame.texture, 0);
}

void Viewport::Impl::copyToCanvas(const DrawnFrame& frame) {
    QOpenGLExtraFunctions& gl = *canvas->context()->extraFunctions();
    const QSize size = deviceSize();
    bindForReading(frame);
    gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas->defaultFramebufferObject());
    gl.glDisable(GL_SCISSOR_TEST);
    const bool sameSize = frame.width == size.width() && frame.height == size.height();
    gl.glBlitFramebuffer(0, 0, frame.width, frame.height, 0, 0, size.width(), size.height(),
                         GL_COLOR_BUFFER_BIT, sameSize ? GL_NEAREST : GL_LINEAR);
    // The texture goes to another thread again; it must not stay attached here.
    gl.glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, canvas->defaultFramebufferObject());
    // Opaque, whatever the renderer left in alpha.
    gl.glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
    gl.glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    gl.glClear(GL_COLOR_BUFFER_BIT);
    gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    source->released();
}

void Viewport::Impl::paintOnCanvas() {
    takeFrame();
    if (source && shown) {
        // Drawing in place leaves its own framebuffer bound.
        copyToCanvas(*shown);
        return;
    }
    QOpenGLFunctions& gl = *canvas->context()->functions();
    gl.glBindFramebuffer(GL_FRAMEBUFFER, canvas->defaultFramebufferObject());
    gl.glClearColor(float(kSky.redF()), float(kSky.greenF()), float(kSky.blueF()), 1.0F);
    gl.glClear(GL_COLOR_BUFFER_BIT);
}

QImage Viewport::Impl::readTexture(const DrawnFrame& frame) {
    QOpenGLExtraFunctions& gl = *canvas->context()->extraFunctions();
    QImage picture(frame.width, frame.height, QImage::Format_RGBX8888);
    bindForReading(frame);
    gl.glPixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.glReadPixels(0, 0, picture.width(), picture.height(), GL_RGBA, GL_UNSIGNED_BYTE,
                    picture.bits());
    gl.glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, canvas->defaultFramebufferObject());
    // OpenGL's rows run from the bottom.
    picture.mirror(false, true);
    return picture;
}

// ---- The widget

Viewport::~Viewport() {
    Impl& d = *m_impl;
    d.motion.stop();
    const bool hasContext = d.canvas != nullptr && d.canvas->context() != nullptr;
    if (hasContext) {
        d.canvas->makeCurrent();
    }
    d.stopDrawing();
    if (hasContext) {
        d.canvas->doneCurrent();
    }
    delete std::exchange(d.canvas, nullptr);
}

void Viewport::paintEvent(QPaintEvent* event) {
    Impl& d = *m_impl;
    if (d.canvas != nullptr) {
        return;  // it lies over all of this
    }
    d.takeFrame();
    QPainter painter(this);
    if (!d.source || !d.shown) {
        painter.fillRect(event->rect(), kSky);
        return;
    }
    const QImage picture = pixelsOf(*d.shown);
    painter.setRenderHint(QPainter::SmoothPixmapTransform, picture.size() != d.deviceSize());
    painter.drawImage(rect(), picture);
}

void Viewport::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const QSize size = m_impl->deviceSize();
    m_impl->state.width = size.width();
    m_impl->state.height = size.height();
    if (m_impl->canvas != nullptr) {
        m_impl->canvas->setGeometry(rect());
    }
    m_impl->hud->layOut();
    m_impl->wipeBar->layOut();
    m_impl->problem->setGeometry(rect());
    m_impl->updateHud();
    m_impl->post(true);
}

void Viewport::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    const QSize size = m_impl->deviceSize();
    m_impl->state.width = size.width();
    m_impl->state.height = size.height();
    m_impl->state.visible = true;
    if (m_impl->canvas == nullptr && !m_impl->source && m_impl->losses == 0) {
        m_impl->startDrawing();
    }
    m_impl->post(true);
    // A canvas that got no context is never asked to paint: it must be seen from outside.
    QTimer::singleShot(0, this, [this] {
        if (isVisible() && m_impl->canvas != nullptr && !m_impl->canvas->isValid()) {
            m_impl->showProblem(noContext());
        }
    });
}

void Viewport::hideEvent(QHideEvent* event) {
    m_impl->endPress(true);
    m_impl->state.visible = false;
    m_impl->post(false);
    QWidget::hideEvent(event);
}

QImage Viewport::grabPicture() {
    Impl& d = *m_impl;
    if (!d.source) {
        return {};
    }
    if (d.canvas == nullptr) {
        d.takeFrame();
        return d.shown ? pixelsOf(*d.shown).copy() : QImage();
    }
    d.canvas->makeCurrent();
    d.takeFrame();
    const QImage picture = d.shown ? d.readTexture(*d.shown) : QImage();
    d.canvas->doneCurrent();
    return picture;
}

quint64 Viewport::revision() const {
    return m_impl->state.revision();
}

quint64 Viewport::picturesFinished() const {
    return m_impl->source ? m_impl->source->finished() : 0;
}

void Viewport::loseContext() {
    if (m_impl->source) {
        m_impl->source->loseContext();
    }
}

}  // namespace reflet
