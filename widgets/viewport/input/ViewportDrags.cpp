// SPDX-License-Identifier: GPL-3.0-or-later
// Drags of the camera and of what is in the project: how they begin, what they say, how they end.
#include "widgets/viewport/ViewportImpl.h"
#include "widgets/viewport/input/PointDrag.h"
#include "widgets/viewport/input/ReflectorDrag.h"
#include "widgets/viewport/input/RouteSnap.h"

#include <algorithm>

namespace reflet {

bool Viewport::Impl::draggable(const Picked& picked) const {
    switch (picked.kind) {
        case Picked::Kind::Probe:
        case Picked::Kind::RouteHandle:
            return true;
        case Picked::Kind::Reflector:
            return picked.id == state.overlays.selectedReflector;
        case Picked::Kind::RouteLine:
            return std::any_of(routes.begin(), routes.end(), [&](const RouteGlyph& route) {
                return route.id == picked.id && route.selected;
            });
    }
    return false;
}

std::unique_ptr<PointerDrag> Viewport::Impl::cameraDrag(CameraDrag::Move how) {
    driver.interrupt();
    leaveFollowing();
    return std::make_unique<CameraDrag>(q.geometry(), pixelOf(pressedAt), std::move(how),
                                        [this](const Camera& camera) { applyCamera(camera); });
}

std::unique_ptr<PointerDrag> Viewport::Impl::followDrag() {
    return std::make_unique<FollowDrag>(pixelOf(pressedAt), state.followOffset,
                                        [this](const FollowOffset& offset) {
                                            state.followOffset = offset;
                                            post(true);
                                        });
}

void Viewport::Impl::tellDragged(const Picked& picked, const glm::dvec3& place, DragPhase phase) {
    const bool over = phase == DragPhase::End || phase == DragPhase::Cancel;
    dragged = picked;
    dragged->point = place;
    if (picked.kind == Picked::Kind::RouteLine) {
        ghost = over ? std::nullopt : std::optional(place);
    }
    if (over) {
        dragged.reset();
    }
    rebuildOverlays(true);
    const QString id = QString::fromStdString(picked.id);
    switch (picked.kind) {
        case Picked::Kind::Probe:
            Q_EMIT intents->probeDragged(id, place, phase);
            break;
        case Picked::Kind::RouteHandle:
            Q_EMIT intents->routePointDragged(id, picked.index, place, phase);
            break;
        case Picked::Kind::RouteLine:
            Q_EMIT intents->routePointInserted(id, picked.index, place, phase);
            break;
        case Picked::Kind::Reflector:
            break;
    }
}

std::unique_ptr<PointerDrag> Viewport::Impl::pointDrag(const Picked& picked) {
    if (picked.kind == Picked::Kind::Reflector) {
        return reflectorDrag(picked);
    }
    PointDrag::Snap snap;
    if (picked.kind == Picked::Kind::Probe) {
        snap = [this](const ViewGeometry& view, const glm::dvec3& place) {
            return snappedToLines(routes, view, place);
        };
    }
    return std::make_unique<PointDrag>(
        q.geometry(), pixelOf(pressedAt), picked.point, state.ground,
        [this, picked](const glm::dvec3& place, DragPhase phase) {
            tellDragged(picked, place, phase);
        },
        std::move(snap));
}

std::unique_ptr<PointerDrag> Viewport::Impl::reflectorDrag(const Picked& picked) {
    if (!state.traffic) {
        return nullptr;
    }
    const Result<std::size_t> index = state.traffic->find(picked.id);
    if (!index) {
        return nullptr;
    }
    const double station = state.traffic->at(*index, secondsShown()).station;
    const QString id = QString::fromStdString(picked.id);
    return std::make_unique<ReflectorDrag>(state.traffic->route(*index).points(), picked.point,
                                           station, [this, id](double where, DragPhase phase) {
                                               Q_EMIT intents->reflectorDragged(id, where, phase);
                                           });
}

void Viewport::Impl::endPress(bool cancel) {
    pendingDrag = nullptr;
    pressed = Qt::NoButton;
    if (const std::unique_ptr<PointerDrag> over = std::move(drag)) {
        cancel ? over->cancel() : over->end();
        hoverAt(mouse);
    }
}

}  // namespace reflet
