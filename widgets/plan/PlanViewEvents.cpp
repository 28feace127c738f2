// SPDX-License-Identifier: GPL-3.0-or-later
// The events of a plan, handed to what they mean: PlanViewInput.cpp.
#include "widgets/plan/PlanView.h"
#include "widgets/plan/PlanViewImpl.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

namespace reflet {

namespace {

constexpr double kClickReach = 4.0;   ///< pixels that the mouse may move within a click
constexpr double kZoomANotch = 1.25;  ///< of the wheel
constexpr double kNotch = 120.0;      ///< Qt's angle of a notch

}  // namespace

void PlanView::mousePressEvent(QMouseEvent* event) {
    if (m_impl->button != Qt::NoButton)
        return;  // a second button during a drag
    if (event->button() != Qt::LeftButton && event->button() != Qt::MiddleButton)
        return;
    m_impl->button = event->button();
    m_impl->pressed = event->position();
    m_impl->moving = false;
    m_impl->doubleClicked = false;
    m_impl->scene.keyCursor.reset();
    m_impl->pressedHit = m_impl->tool == ViewportTool::DrawRoute
                             ? PlanHit{}
                             : hitTest(m_impl->scene, m_impl->transform, event->position());
}

void PlanView::mouseMoveEvent(QMouseEvent* event) {
    m_impl->cursor = event->position();
    if (m_impl->button != Qt::NoButton) {
        const QPointF way = event->position() - m_impl->pressed;
        if (!m_impl->moving && std::hypot(way.x(), way.y()) > kClickReach)
            m_impl->beginDrag();
        if (m_impl->moving)
            m_impl->continueDrag(event->position());
    } else {
        m_impl->scene.keyCursor.reset();
        m_impl->hover(event->position());
    }
    update();
}

void PlanView::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != m_impl->button)
        return;
    if (m_impl->moving) {
        m_impl->endDrag();
        return;
    }
    const bool left = m_impl->button == Qt::LeftButton;
    m_impl->button = Qt::NoButton;
    if (left && !m_impl->doubleClicked)
        m_impl->click(event->position(),
                      event->modifiers() & (Qt::ControlModifier | Qt::ShiftModifier));
}

void PlanView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton)
        return;
    m_impl->doubleClicked = true;
    if (m_impl->tool == ViewportTool::DrawRoute) {
        m_impl->finishRoute();
        return;
    }
    if (m_impl->tool == ViewportTool::PlaceProbe)
        return;
    const PlanHit hit = hitTest(m_impl->scene, m_impl->transform, event->position());
    if (const auto item = Impl::itemOf(hit)) {
        Q_EMIT activated(*item);
        return;
    }
    m_impl->transform.zoom(2.0, event->position());
    m_impl->framed = true;
    update();
}

void PlanView::wheelEvent(QWheelEvent* event) {
    const double notches = event->angleDelta().y() / kNotch;
    m_impl->transform.zoom(std::pow(kZoomANotch, notches), event->position());
    m_impl->framed = true;
    event->accept();
    update();
}

void PlanView::keyPressEvent(QKeyEvent* event) {
    const bool cancelled = event->key() == Qt::Key_Escape && m_impl->moving;
    if (cancelled)
        m_impl->cancelDrag();
    if (cancelled || m_impl->toolKey(event) || m_impl->navigationKey(event))
        update();
    else
        QWidget::keyPressEvent(event);
}

void PlanView::leaveEvent(QEvent* event) {
    QWidget::leaveEvent(event);
    m_impl->cursor.reset();
    m_impl->clearHover();
    update();
}

void PlanView::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    m_impl->scene.keyCursor.reset();
    update();
}

void PlanView::contextMenuEvent(QContextMenuEvent* event) {
    QPointF point = event->pos();
    if (event->reason() == QContextMenuEvent::Keyboard)
        point = m_impl->keyPoint();
    const PlanHit hit = hitTest(m_impl->scene, m_impl->transform, point);
    const glm::dvec3 ground = m_impl->onGround(m_impl->transform.toFrame(point));
    Q_EMIT m_impl->intents->contextMenuAt(mapToGlobal(point.toPoint()), Impl::itemOf(hit), ground);
}

}  // namespace reflet
