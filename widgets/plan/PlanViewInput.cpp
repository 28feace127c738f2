// SPDX-License-Identifier: GPL-3.0-or-later
// What drags, clicks and keys mean in a plan; PlanViewEvents.cpp hands them over.
#include "widgets/plan/PlanView.h"
#include "widgets/plan/PlanViewImpl.h"

#include <QKeyEvent>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kClickReach = 4.0;   ///< pixels that the mouse may move within a click
constexpr double kZoomANotch = 1.25;  ///< of the wheel
constexpr double kKeyPan = 60.0;      ///< pixels
constexpr double kKeyStep = 16.0;     ///< pixels that an arrow key moves the cross
constexpr double kFineKeyStep = 1.0;  ///< with Shift

bool draggable(PlanHit::Kind kind) {
    return kind == PlanHit::Kind::Probe || kind == PlanHit::Kind::Corner ||
           kind == PlanHit::Kind::Middle || kind == PlanHit::Kind::CameraEye ||
           kind == PlanHit::Kind::CameraTarget;
}

QPointF arrow(int key) {
    switch (key) {
        case Qt::Key_Left:
            return {-1.0, 0.0};
        case Qt::Key_Right:
            return {1.0, 0.0};
        case Qt::Key_Up:
            return {0.0, -1.0};
        case Qt::Key_Down:
            return {0.0, 1.0};
        default:
            return {};
    }
}

}  // namespace

void PlanView::Impl::reportDrag(const glm::dvec3& position, DragPhase phase) {
    const QString id = QString::fromStdString(pressedHit.id);
    switch (pressedHit.kind) {
        case PlanHit::Kind::Probe:
            Q_EMIT intents->probeDragged(id, position, phase);
            break;
        case PlanHit::Kind::Corner:
            Q_EMIT intents->routePointDragged(id, pressedHit.index, position, phase);
            break;
        case PlanHit::Kind::Middle:
            Q_EMIT intents->routePointInserted(id, pressedHit.index + 1, position, phase);
            break;
        default:
            break;
    }
}

void PlanView::Impl::beginDrag() {
    moving = true;
    panning = button == Qt::MiddleButton || !draggable(pressedHit.kind);
    if (panning) {
        panFrom = transform.toFrame(pressed);
        view->setCursor(Qt::ClosedHandCursor);
        return;
    }
    if (pressedHit.kind == PlanHit::Kind::CameraEye ||
        pressedHit.kind == PlanHit::Kind::CameraTarget) {
        cameraDrag.press(*scene.camera);
        return;
    }
    if (const ProbeGlyph* probe = scene.probe(pressedHit.id);
        probe && pressedHit.kind == PlanHit::Kind::Probe) {
        grabbed = probe->position;
        if (!probe->selected)
            Q_EMIT intents->clicked(itemOf(pressedHit), false);
    } else if (const RouteGlyph* route = scene.route(pressedHit.id)) {
        const auto index = std::size_t(pressedHit.index);
        grabbed = pressedHit.kind == PlanHit::Kind::Corner
                      ? route->handles[index]
                      : 0.5 * (route->handles[index] + route->handles[index + 1]);
    }
    drag.press(grabbed);
}

void PlanView::Impl::continueDrag(const QPointF& point) {
    if (panning) {
        transform.center += panFrom - transform.toFrame(point);
        framed = true;
        view->update();
        return;
    }
    const glm::dvec2 shift = transform.toFrame(point) - transform.toFrame(pressed);
    if (cameraDrag.pressed()) {
        Camera camera = cameraDrag.before();
        if (pressedHit.kind == PlanHit::Kind::CameraEye) {
            const auto from = knownGround(camera.position.x, camera.position.y);
            const auto to = knownGround(camera.position.x + shift.x, camera.position.y + shift.y);
            const glm::dvec3 move(shift, from && to ? *to - *from : 0.0);
            camera.position += move;
            camera.target += move;
        } else {
            const glm::dvec2 ahead = transform.toFrame(point) - glm::dvec2(camera.position);
            const double far = glm::length(glm::dvec2(camera.target - camera.position));
            if (glm::length(ahead) > 1e-9)
                camera.target = glm::dvec3(
                    glm::dvec2(camera.position) + glm::normalize(ahead) * std::max(far, 1e-3),
                    camera.target.z);
        }
        cameraDrag.step(camera);
        return;
    }
    if (!drag.pressed())
        return;
    glm::dvec3 position = grabbed + glm::dvec3(shift, 0.0);
    const auto to = knownGround(position.x, position.y);
    if (pressedHit.kind != PlanHit::Kind::Probe) {
        position.z = to.value_or(grabbed.z);
    } else if (const auto from = knownGround(grabbed.x, grabbed.y); from && to) {
        position.z = grabbed.z + *to - *from;  // a probe keeps its height above the ground
    }
    drag.step(position);
}

void PlanView::Impl::endDrag() {
    drag.release();
    cameraDrag.release();
    button = Qt::NoButton;
    moving = false;
    panning = false;
    showCursor();
}

bool PlanView::Impl::cancelDrag() {
    const bool cancelled = drag.cancel();
    const bool cancelledCamera = cameraDrag.cancel();
    if (moving)
        endDrag();
    button = Qt::NoButton;
    return cancelled || cancelledCamera;
}

void PlanView::Impl::click(const QPointF& point, bool extend) {
    const glm::dvec3 at = onGround(transform.toFrame(point));
    if (tool == ViewportTool::DrawRoute) {
        std::vector<glm::dvec3> points = scene.draft;
        points.push_back(at);
        setDraft(std::move(points));
        return;
    }
    if (tool == ViewportTool::PlaceProbe && pressedHit.kind != PlanHit::Kind::Probe) {
        Q_EMIT intents->probePlaced(at + glm::dvec3(0.0, 0.0, kNewProbeHeight));
        return;
    }
    if (pressedHit.kind == PlanHit::Kind::Ghost) {
        Q_EMIT intents->ghostClicked(QString::fromStdString(pressedHit.id));
        return;
    }
    scene.chosenCorner = pressedHit.kind == PlanHit::Kind::Corner ? pressedHit : PlanHit{};
    view->update();
    if (pressedHit.kind != PlanHit::Kind::Corner && pressedHit.kind != PlanHit::Kind::Middle)
        Q_EMIT intents->clicked(itemOf(pressedHit), extend);
}

void PlanView::Impl::hover(const QPointF& point) {
    const PlanHit hit =
        tool == ViewportTool::DrawRoute ? PlanHit{} : hitTest(scene, transform, point);
    const bool changed = hit != scene.hover;
    const auto item = itemOf(hit);
    const bool itemChanged = changed && item != itemOf(scene.hover);
    scene.hover = hit;
    if (tool != ViewportTool::Navigate)
        scene.draftCursor = onGround(transform.toFrame(point));
    if (changed)
        showCursor();
    if (itemChanged)
        Q_EMIT view->hovered(item);
}

void PlanView::Impl::clearHover() {
    const bool item = itemOf(scene.hover).has_value();
    scene.hover = {};
    if (!scene.keyCursor)
        scene.draftCursor.reset();
    if (item)
        Q_EMIT view->hovered(std::nullopt);
}

void PlanView::Impl::showCursor() {
    if (tool != ViewportTool::Navigate && scene.hover.kind != PlanHit::Kind::Probe)
        view->setCursor(Qt::CrossCursor);
    else if (draggable(scene.hover.kind))
        view->setCursor(Qt::SizeAllCursor);
    else if (scene.hover.kind != PlanHit::Kind::None)
        view->setCursor(Qt::PointingHandCursor);
    else
        view->unsetCursor();
}

void PlanView::Impl::leaveTool() {
    view->setTool(ViewportTool::Navigate);
    Q_EMIT intents->toolChanged(ViewportTool::Navigate);
}

/// A double click puts its point twice: points that coincide count once.
void PlanView::Impl::finishRoute() {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& point : scene.draft)
        if (points.empty() ||
            glm::length(glm::dvec2(point - points.back())) * transform.scale > kClickReach)
            points.push_back(point);
    if (points.size() < 2)
        return;
    leaveTool();
    Q_EMIT intents->routeDrawn(points);
}

void PlanView::Impl::setDraft(std::vector<glm::dvec3> points) {
    if (points.size() == scene.draft.size())
        return;
    scene.draft = std::move(points);
    view->update();
    Q_EMIT intents->routeGrowing(int(scene.draft.size()));
}

bool PlanView::Impl::wants(int key) const {
    const bool viewing =
        key == Qt::Key_Home || key == Qt::Key_Plus || key == Qt::Key_Minus || !arrow(key).isNull();
    const bool drawing = key == Qt::Key_Space || key == Qt::Key_Return || key == Qt::Key_Enter ||
                         key == Qt::Key_Backspace || key == Qt::Key_Delete;
    return viewing || (tool != ViewportTool::Navigate && (drawing || key == Qt::Key_Escape)) ||
           (moving && key == Qt::Key_Escape) ||
           (key == Qt::Key_Delete && scene.chosenCorner.kind == PlanHit::Kind::Corner);
}

QPointF PlanView::Impl::keyPoint() const {
    return scene.keyCursor.value_or(
        cursor.value_or(QPointF(0.5 * view->width(), 0.5 * view->height())));
}

bool PlanView::Impl::toolKey(QKeyEvent* event) {
    if (tool == ViewportTool::Navigate)
        return false;
    if (const QPointF way = arrow(event->key()); !way.isNull()) {
        const bool fine = event->modifiers().testFlag(Qt::ShiftModifier);
        QPointF next = keyPoint() + way * (fine ? kFineKeyStep : kKeyStep);
        next.setX(std::clamp(next.x(), 0.0, double(view->width() - 1)));
        next.setY(std::clamp(next.y(), 0.0, double(view->height() - 1)));
        scene.keyCursor = next;
        cursor = next;
        hover(next);
        return true;
    }
    const bool route = tool == ViewportTool::DrawRoute;
    switch (event->key()) {
        case Qt::Key_Space:
            pressedHit = {};
            click(keyPoint(), false);
            return true;
        case Qt::Key_Return:
        case Qt::Key_Enter:
            if (route)
                finishRoute();
            else
                click(keyPoint(), false);
            return true;
        case Qt::Key_Backspace:
        case Qt::Key_Delete:
            if (route && !scene.draft.empty())
                setDraft({scene.draft.begin(), scene.draft.end() - 1});
            return route;
        case Qt::Key_Escape:
            if (scene.draft.empty())
                leaveTool();
            else
                setDraft({});
            return true;
        default:
            return false;
    }
}

bool PlanView::Impl::navigationKey(QKeyEvent* event) {
    const QPointF middle(0.5 * view->width(), 0.5 * view->height());
    if (const QPointF way = arrow(event->key()); !way.isNull()) {
        transform.center += glm::dvec2(way.x(), -way.y()) * (kKeyPan / transform.scale);
        framed = true;
        return true;
    }
    switch (event->key()) {
        case Qt::Key_Home:
            view->frameAll();
            return true;
        case Qt::Key_Plus:
        case Qt::Key_Equal:
        case Qt::Key_Minus:
            transform.zoom(event->key() == Qt::Key_Minus ? 1.0 / kZoomANotch : kZoomANotch,
                           cursor.value_or(middle));
            framed = true;
            return true;
        case Qt::Key_Delete:
            if (scene.chosenCorner.kind != PlanHit::Kind::Corner) {
                Q_EMIT intents->removeRequested();
            } else if (const RouteGlyph* route = scene.route(scene.chosenCorner.id);
                       route && route->handles.size() > 2) {
                const int index = scene.chosenCorner.index;
                scene.chosenCorner = {};
                Q_EMIT intents->routePointRemoved(QString::fromStdString(route->id), index);
            }
            return true;
        case Qt::Key_Escape:
            if (scene.chosenCorner.kind == PlanHit::Kind::None)
                return false;
            scene.chosenCorner = {};
            return true;
        default:
            return false;
    }
}

}  // namespace reflet
