// SPDX-License-Identifier: GPL-3.0-or-later
// What is under the mouse, and what clicks mean with each tool.
#include "core/gpu/overlay/CoverageOverlay.h"
#include "widgets/viewport/ViewportImpl.h"
#include "widgets/viewport/input/RouteSnap.h"

#include <glm/geometric.hpp>

namespace reflet {

namespace {

constexpr double kReach = 9.0;        // pixels that a click may miss a small thing by
constexpr double kGhostReach = 14.0;  // pixels from the middle of a suggested probe
constexpr double kNoGround = 15.0;    // metres: pivot where the mouse is over the sky

}  // namespace

std::optional<Picked> Viewport::Impl::pickAt(const QPointF& at) const {
    return pick(q.geometry(), {&probes, &routes, &reflectors}, pixelOf(at), kReach);
}

std::string Viewport::Impl::ghostAt(const QPointF& at) const {
    const auto& coverage = state.overlays.coverage;
    if (!coverage || tool != ViewportTool::Navigate) {
        return {};
    }
    const ViewGeometry view = q.geometry();
    std::string best;
    double least = kGhostReach;
    for (const GhostProbe& probe : coverage->ghosts) {
        const ProjectedPoint place = view.project(probe.position);
        const double away = glm::distance(place.pixel, pixelOf(at));
        if (place.depth > 0.0 && away <= least) {
            least = away;
            best = probe.id;
        }
    }
    return best;
}

glm::dvec3 Viewport::Impl::pivotAt(const QPointF& at) const {
    const ViewGeometry view = q.geometry();
    const Ray ray = view.ray(pixelOf(at));
    std::optional<glm::dvec3> point = state.ground->pointUnder(ray);
    double nearest = point ? glm::distance(*point, ray.origin) : kNoGround;
    for (const BoxedReflector& reflector : reflectors) {
        const std::optional<double> t = reflector.hit(ray);
        if (t && *t > 0.0 && *t < nearest) {
            nearest = *t;
        }
    }
    return ray.at(nearest);
}

void Viewport::Impl::hoverAt(const std::optional<QPointF>& at) {
    mouse = at;
    std::optional<Picked> under;
    std::optional<glm::dvec3> place;
    if (at && !driver.walking() && !drag) {
        const Ray ray = q.geometry().ray(pixelOf(*at));
        switch (tool) {
            case ViewportTool::Navigate:
                under = pickAt(*at);
                break;
            case ViewportTool::PlaceProbe:
                place = state.ground->probePlaceUnder(ray);
                break;
            case ViewportTool::DrawRoute:
                place = state.ground->streetUnder(ray);
                break;
        }
        if (place && tool == ViewportTool::DrawRoute) {
            place = snappedToCorners(routes, q.geometry(), *place);
        }
    }
    if (!drag) {
        hovered = under;
    }
    ghost = place;
    rebuildOverlays(place.has_value());
    updateCursor();
}

void Viewport::Impl::updateCursor() {
    Qt::CursorShape shape = Qt::ArrowCursor;
    if (drag) {
        shape = Qt::ClosedHandCursor;
    } else if (tool != ViewportTool::Navigate) {
        shape = Qt::CrossCursor;
    } else if (mouse && !ghostAt(*mouse).empty()) {
        shape = Qt::PointingHandCursor;
    } else if (hovered) {
        shape = draggable(*hovered) ? Qt::OpenHandCursor : Qt::PointingHandCursor;
    }
    if (q.cursor().shape() != shape) {
        q.setCursor(shape);
    }
}

// ---- Tools

void Viewport::Impl::clearDraft() {
    draft.clear();
    rebuildOverlays(false);
    Q_EMIT intents->routeGrowing(0);
}

void Viewport::Impl::changeTool(ViewportTool to, bool finish) {
    if (to == tool) {
        return;
    }
    tool = to;
    ghost.reset();
    if (!draft.empty()) {
        const std::vector<glm::dvec3> points = draft;
        clearDraft();
        if (finish && points.size() >= 2) {
            Q_EMIT intents->routeDrawn(points);
        }
    }
    if (to != ViewportTool::Navigate) {
        q.setWalking(false);
    }
    hoverAt(mouse);
    Q_EMIT intents->toolChanged(to);
}

void Viewport::Impl::addDraftPoint(const QPointF& at) {
    const ViewGeometry view = q.geometry();
    std::optional<glm::dvec3> place = state.ground->streetUnder(view.ray(pixelOf(at)));
    if (!place) {
        return;
    }
    place = snappedToCorners(routes, view, *place);
    if (draft.empty() || glm::distance(draft.back(), *place) > 1e-6) {
        draft.push_back(*place);
        rebuildOverlays(false);
        Q_EMIT intents->routeGrowing(int(draft.size()));
    }
}

void Viewport::Impl::clickAt(const QPointF& at, bool extend) {
    switch (tool) {
        case ViewportTool::PlaceProbe:
            if (const auto place = state.ground->probePlaceUnder(q.geometry().ray(pixelOf(at)))) {
                Q_EMIT intents->probePlaced(*place);
            }
            return;
        case ViewportTool::DrawRoute:
            addDraftPoint(at);
            return;
        case ViewportTool::Navigate:
            break;
    }
    const std::optional<Picked> picked = pickAt(at);
    const bool probe = picked && picked->kind == Picked::Kind::Probe;
    if (const std::string suggested = ghostAt(at); !suggested.empty() && !probe) {
        Q_EMIT intents->ghostClicked(QString::fromStdString(suggested));
        return;
    }
    Q_EMIT intents->clicked(picked ? std::optional(picked->item()) : std::nullopt, extend);
}

bool Viewport::Impl::cancelSomething() {
    if (drag) {
        endPress(true);
    } else if (!draft.empty()) {
        clearDraft();
    } else if (!q.markedObject().isEmpty()) {
        q.markObject({}, {});
    } else if (tool != ViewportTool::Navigate) {
        changeTool(ViewportTool::Navigate, false);
    } else if (driver.walking()) {
        q.setWalking(false);
    } else if (!state.followed.empty()) {
        leaveFollowing();
    } else {
        return false;
    }
    return true;
}

}  // namespace reflet
