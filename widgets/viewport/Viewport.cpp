// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/Viewport.h"

#include <QOpenGLContext>
#include <QOpenGLFunctions>

namespace reflet {

struct Viewport::Impl {
    Camera camera;
    std::string followed;
    ViewportTool tool = ViewportTool::Navigate;
    float wipe = 0.5F;
    double time = 0.0;
    bool playing = false;
    bool walking = false;
};

Viewport::Viewport(QWidget* parent) : QOpenGLWidget(parent), m_impl(std::make_unique<Impl>()) {}
Viewport::~Viewport() = default;

void Viewport::setCity(std::shared_ptr<const DrawnCity> /*city*/) {}
void Viewport::setLighting(const Lighting& /*lighting*/) {}
void Viewport::setAmbient(std::shared_ptr<const AmbientVolume> /*ambient*/) {}
void Viewport::setRems(const RemSet& /*rems*/) {}
void Viewport::setTraffic(std::shared_ptr<const Traffic> /*traffic*/) {}
void Viewport::setTuning(const MemSettings& /*tuning*/) {}
void Viewport::setExposure(float /*exposure*/) {}
void Viewport::setMethods(Method /*left*/, std::optional<Method> /*right*/) {}
void Viewport::setWipe(float share) {
    m_impl->wipe = share;
}
float Viewport::wipe() const {
    return m_impl->wipe;
}
void Viewport::setGivenMaps(GivenMaps /*maps*/) {}
void Viewport::setProbes(std::vector<ProbeGlyph> /*probes*/) {}
void Viewport::setRoutes(std::vector<RouteGlyph> /*routes*/) {}
void Viewport::setSelectedReflector(std::string /*id*/) {}
void Viewport::setHeightfieldShown(bool /*shown*/) {}
void Viewport::setCamera(const Camera& camera, bool /*animate*/) {
    m_impl->camera = camera;
    Q_EMIT cameraChanged();
}
Camera Viewport::camera() const {
    return m_impl->camera;
}
void Viewport::frameAll() {}
void Viewport::frameSelection() {}
void Viewport::frameBox(const Box& /*box*/) {}
void Viewport::setWalking(bool walking) {
    m_impl->walking = walking;
    Q_EMIT walkingChanged(walking);
}
bool Viewport::walking() const {
    return m_impl->walking;
}
void Viewport::follow(std::string reflector) {
    m_impl->followed = std::move(reflector);
    Q_EMIT followedChanged(QString::fromStdString(m_impl->followed));
}
const std::string& Viewport::followed() const {
    return m_impl->followed;
}
void Viewport::setReducedMotion(bool /*reduced*/) {}
void Viewport::setTool(ViewportTool tool) {
    m_impl->tool = tool;
    Q_EMIT toolChanged(tool);
}
ViewportTool Viewport::tool() const {
    return m_impl->tool;
}
void Viewport::setTime(double seconds) {
    m_impl->time = seconds;
    Q_EMIT timeChanged(seconds);
}
double Viewport::time() const {
    return m_impl->time;
}
void Viewport::setPlaying(bool playing) {
    m_impl->playing = playing;
    Q_EMIT playingChanged(playing);
}
bool Viewport::playing() const {
    return m_impl->playing;
}
void Viewport::setSmoothness(double /*framesPerSecond*/) {}
void Viewport::setHudShown(bool /*shown*/) {}
void Viewport::setFiguresShown(bool /*shown*/) {}
QImage Viewport::grabPicture() {
    return grabFramebuffer();
}
QSize Viewport::sizeHint() const {
    return {960, 600};
}
QSize Viewport::minimumSizeHint() const {
    return {240, 160};
}

void Viewport::initializeGL() {}
void Viewport::paintGL() {
    context()->functions()->glClearColor(0.62F, 0.74F, 0.88F, 1.0F);
    context()->functions()->glClear(GL_COLOR_BUFFER_BIT);
}
bool Viewport::event(QEvent* event) {
    return QOpenGLWidget::event(event);
}
void Viewport::resizeEvent(QResizeEvent* event) {
    QOpenGLWidget::resizeEvent(event);
}
void Viewport::showEvent(QShowEvent* event) {
    QOpenGLWidget::showEvent(event);
}
void Viewport::hideEvent(QHideEvent* event) {
    QOpenGLWidget::hideEvent(event);
}
void Viewport::mousePressEvent(QMouseEvent* /*event*/) {}
void Viewport::mouseMoveEvent(QMouseEvent* /*event*/) {}
void Viewport::mouseReleaseEvent(QMouseEvent* /*event*/) {}
void Viewport::mouseDoubleClickEvent(QMouseEvent* /*event*/) {}
void Viewport::wheelEvent(QWheelEvent* /*event*/) {}
void Viewport::keyPressEvent(QKeyEvent* event) {
    QOpenGLWidget::keyPressEvent(event);
}
void Viewport::keyReleaseEvent(QKeyEvent* event) {
    QOpenGLWidget::keyReleaseEvent(event);
}
void Viewport::leaveEvent(QEvent* event) {
    QOpenGLWidget::leaveEvent(event);
}
void Viewport::focusOutEvent(QFocusEvent* event) {
    QOpenGLWidget::focusOutEvent(event);
}

}  // namespace reflet
