// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plan/PlanView.h"

namespace reflet {
struct PlanView::Impl {
    ViewportTool tool = ViewportTool::Navigate;
};
PlanView::PlanView(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>()) {}
PlanView::~PlanView() = default;
void PlanView::setCity(std::shared_ptr<const DrawnCity>) {}
void PlanView::setHeightfield(std::shared_ptr<const Heightfield>) {}
void PlanView::setFrame(const ProjectFrame&, const QString&) {}
void PlanView::setProbes(std::vector<ProbeGlyph>) {}
void PlanView::setRoutes(std::vector<RouteGlyph>) {}
void PlanView::setTraffic(std::shared_ptr<const Traffic>) {}
void PlanView::setTime(double) {}
void PlanView::setCamera(const Camera&) {}
void PlanView::setSelectedReflector(const std::string&) {}
void PlanView::setTool(ViewportTool tool) {
    m_impl->tool = tool;
}
ViewportTool PlanView::tool() const {
    return m_impl->tool;
}
void PlanView::frameAll() {}
void PlanView::frameBox(const Box&) {}
QPointF PlanView::toWidget(const glm::dvec3&) const {
    return {};
}
glm::dvec3 PlanView::toFrame(const QPointF&) const {
    return {};
}
double PlanView::scale() const {
    return 1.0;
}
double PlanView::groundHeight(double, double) const {
    return 0.0;
}
QSize PlanView::sizeHint() const {
    return {400, 400};
}
QSize PlanView::minimumSizeHint() const {
    return {120, 120};
}
void PlanView::paintEvent(QPaintEvent*) {}
void PlanView::mousePressEvent(QMouseEvent*) {}
void PlanView::mouseMoveEvent(QMouseEvent*) {}
void PlanView::mouseReleaseEvent(QMouseEvent*) {}
void PlanView::mouseDoubleClickEvent(QMouseEvent*) {}
void PlanView::wheelEvent(QWheelEvent*) {}
void PlanView::keyPressEvent(QKeyEvent*) {}
void PlanView::leaveEvent(QEvent*) {}
void PlanView::focusOutEvent(QFocusEvent*) {}
void PlanView::resizeEvent(QResizeEvent*) {}
void PlanView::contextMenuEvent(QContextMenuEvent*) {}
bool PlanView::event(QEvent* event) {
    return QWidget::event(event);
}
}  // namespace reflet
