// SPDX-License-Identifier: GPL-3.0-or-later
// The mouse of the viewport: presses become clicks or drags.
#include "widgets/viewport/ViewportImpl.h"

#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

namespace reflet {

namespace {

constexpr double kDragThreshold = 4.0;  // pixels before a press becomes a drag
constexpr double kWheelStep = 0.82;     // of the distance that a notch leaves
constexpr double kWheelNotch = 120.0;   // Qt's eighths of a degree
constexpr double kProbeView = 5.0;      // metres around a probe that is framed by a double click

}  // namespace

void Viewport::mousePressEvent(QMouseEvent* event) {
    Impl& d = *m_impl;
    if (d.pressed != Qt::NoButton) {
        return;
    }
    d.pressed = event->button();
    d.pressedAt = event->position();
    const bool shift = (event->modifiers() & Qt::ShiftModifier) != 0;
    const bool left = event->button() == Qt::LeftButton;
    const std::optional<Picked> picked = left && d.tool == ViewportTool::Navigate
                                             ? d.pickAt(event->position())
                                             : std::optional<Picked>();
    if (d.driver.walking()) {
        d.pendingDrag = [&d] { return d.cameraDrag(drags::look()); };
    } else if (picked && d.draggable(*picked)) {
        d.pendingDrag = [&d, what = *picked] { return d.pointDrag(what); };
    } else if (left && !shift && !d.state.followed.empty()) {
        d.pendingDrag = [&d] { return d.followDrag(); };
    } else {
        const glm::dvec3 pivot = d.pivotAt(event->position());
        const bool orbit = left && !shift;
        d.pendingDrag = [&d, pivot, orbit] {
            return d.cameraDrag(orbit ? drags::orbit(pivot) : drags::pan(pivot));
        };
    }
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
    Impl& d = *m_impl;
    d.mouse = event->position();
    if (d.pendingDrag && !d.drag) {
        const QPointF way = event->position() - d.pressedAt;
        if (std::hypot(way.x(), way.y()) < kDragThreshold) {
            return;
        }
        d.drag = d.pendingDrag();
        d.pendingDrag = nullptr;
        d.updateCursor();
    }
    if (d.drag) {
        const Pointer pointer{Impl::pixelOf(event->position()),
                              (event->modifiers() & Qt::ShiftModifier) != 0,
                              (event->modifiers() & Qt::AltModifier) != 0};
        d.drag->move(geometry(), pointer);
    } else if (d.pressed == Qt::NoButton) {
        d.hoverAt(event->position());
    }
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
    Impl& d = *m_impl;
    d.mouse = event->position();
    if (event->button() != d.pressed) {
        return;
    }
    const bool click = !d.drag && d.pendingDrag;
    d.endPress(false);
    if (!click) {
        return;
    }
    if (event->button() == Qt::LeftButton) {
        constexpr auto extending = Qt::ShiftModifier | Qt::ControlModifier;
        d.clickAt(event->position(), (event->modifiers() & extending) != 0);
    } else if (event->button() == Qt::RightButton) {
        const std::optional<Picked> picked = d.pickAt(event->position());
        const Ray ray = geometry().ray(Impl::pixelOf(event->position()));
        Q_EMIT d.intents->contextMenuAt(
            event->globalPosition().toPoint(),
            picked ? std::optional(picked->item()) : std::nullopt,
            d.state.ground->streetUnder(ray).value_or(d.pivotAt(event->position())));
    }
}

void Viewport::mouseDoubleClickEvent(QMouseEvent* event) {
    Impl& d = *m_impl;
    if (event->button() != Qt::LeftButton || d.driver.walking()) {
        return;
    }
    if (d.tool == ViewportTool::DrawRoute) {
        // The first click of the two has put the last point already, unless the mouse has moved.
        d.addDraftPoint(event->position());
        if (d.draft.size() >= 2) {
            d.changeTool(ViewportTool::Navigate, true);
        }
        return;
    }
    if (d.tool != ViewportTool::Navigate) {
        mousePressEvent(event);
        return;
    }
    const std::optional<Picked> picked = d.pickAt(event->position());
    if (picked && picked->kind == Picked::Kind::Probe) {
        Box box;
        box.add(picked->point - kProbeView);
        box.add(picked->point + kProbeView);
        frameBox(box);
    } else if (picked && picked->kind == Picked::Kind::RouteLine && d.draggable(*picked)) {
        Q_EMIT d.intents->routePointInserted(QString::fromStdString(picked->id), picked->index,
                                             picked->point, DragPhase::End);
    } else if (picked && picked->kind == Picked::Kind::Reflector) {
        follow(picked->id);
    }
}

void Viewport::wheelEvent(QWheelEvent* event) {
    Impl& d = *m_impl;
    const double notches = event->angleDelta().y() / kWheelNotch;
    const double factor = std::pow(kWheelStep, notches);
    event->accept();
    if (notches == 0.0 || d.driver.walking() || d.drag) {
        return;
    }
    if (!d.state.followed.empty()) {
        d.state.followOffset = zoomedFollow(d.state.followOffset, factor);
        d.post(true);
        return;
    }
    d.driver.interrupt();
    d.applyCamera(zoomed(d.driver.camera(), d.pivotAt(event->position()), factor));
    d.hoverAt(event->position());
}

void Viewport::leaveEvent(QEvent* event) {
    m_impl->hoverAt(std::nullopt);
    QWidget::leaveEvent(event);
}

}  // namespace reflet
