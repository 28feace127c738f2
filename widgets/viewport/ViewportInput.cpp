// SPDX-License-Identifier: GPL-3.0-or-later
// Mouse, keys and tools of the viewport.
#include "widgets/viewport/ViewportImpl.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kReach = 9.0;          // pixels that a click may miss a small thing by
constexpr double kDragThreshold = 4.0;  // pixels before a press becomes a drag
constexpr double kSnapReach = 9.0;      // pixels
constexpr double kNoGround = 15.0;      // metres: pivot where the mouse is over the sky
constexpr double kWheelStep = 0.82;     // of the distance that a notch leaves
constexpr double kWheelNotch = 120.0;   // Qt's eighths of a degree
constexpr double kKeyMove = 0.1;        // of the distance to what is looked at
constexpr double kKeyTurn = 8.0 / 180.0 * kPi;
constexpr double kKeyZoom = 0.8;
constexpr double kSideSteepest = -0.6, kSideFlattest = -0.15;    // radians: a view from a side
constexpr double kFollowFlattest = 0.03, kFollowSteepest = 1.5;  // radians
constexpr double kFollowNearest = 3.0, kFollowFarthest = 300.0;  // metres
constexpr double kProbeView = 5.0;  // metres around a probe that is framed by a double click

glm::dvec2 pixelOf(const QPointF& at) {
    return {at.x(), at.y()};
}

/// Tells which station of its route a vehicle is dragged to: the one nearest to the place under the
/// mouse, at the height of the vehicle.
class ReflectorDrag : public PointerDrag {
public:
    using Tell = std::function<void(double, DragPhase)>;
    ReflectorDrag(std::vector<glm::dvec3> line, const glm::dvec3& grabbed, double station,
                  Tell tell)
        : m_line(std::move(line)),
          m_height(grabbed.z),
          m_before(station),
          m_station(station),
          m_offset(station - nearestStation(m_line, grabbed)),
          m_tell(std::move(tell)) {}

    void move(const ViewGeometry& view, const Pointer& pointer) override {
        const Ray ray = view.ray(pointer.pixel);
        const double t = (m_height - ray.origin.z) / ray.direction.z;
        if (!std::isfinite(t) || t <= 0.0) {
            return;
        }
        const double station = std::max(0.0, nearestStation(m_line, ray.at(t)) + m_offset);
        if (station != m_station) {
            m_station = station;
            m_tell(m_station, m_begun ? DragPhase::Move : DragPhase::Begin);
            m_begun = true;
        }
    }
    void end() override {
        if (m_begun) {
            m_tell(m_station, DragPhase::End);
        }
    }
    void cancel() override {
        if (m_begun) {
            m_tell(m_before, DragPhase::Cancel);
        }
    }

private:
    std::vector<glm::dvec3> m_line;
    double m_height;
    double m_before;
    double m_station;
    double m_offset;  ///< from where it was grabbed to its middle
    Tell m_tell;
    bool m_begun = false;
};

/// Turns the camera about the vehicle that it goes along with.
class FollowDrag : public PointerDrag {
public:
    FollowDrag(const glm::dvec2& from, FollowOffset start,
               std::function<void(const FollowOffset&)> apply)
        : m_from(from), m_start(start), m_apply(std::move(apply)) {}

    void move(const ViewGeometry& /*view*/, const Pointer& pointer) override {
        const glm::dvec2 turn = drags::turnFor(pointer.pixel - m_from);
        FollowOffset offset = m_start;
        offset.yaw += turn.x;
        offset.pitch = std::clamp(offset.pitch - turn.y, kFollowFlattest, kFollowSteepest);
        m_apply(offset);
    }
    void cancel() override { m_apply(m_start); }

private:
    glm::dvec2 m_from;
    FollowOffset m_start;
    std::function<void(const FollowOffset&)> m_apply;
};

}  // namespace

bool isWalkKey(int key) {
    switch (key) {
        case Qt::Key_W:
        case Qt::Key_A:
        case Qt::Key_S:
        case Qt::Key_D:
        case Qt::Key_Up:
        case Qt::Key_Down:
        case Qt::Key_Left:
        case Qt::Key_Right:
            return true;
        default:
            return false;
    }
}

// ---- What is under the mouse

std::optional<Picked> Viewport::Impl::pickAt(const QPointF& at) const {
    return pick(q.geometry(), {&probes, &routes, &reflectors}, pixelOf(at), kReach);
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
            place = snappedToRoutes(q.geometry(), *place, false);
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
    } else if (hovered) {
        shape = draggable(*hovered) ? Qt::OpenHandCursor : Qt::PointingHandCursor;
    }
    if (q.cursor().shape() != shape) {
        q.setCursor(shape);
    }
}

glm::dvec3 Viewport::Impl::snappedToRoutes(const ViewGeometry& view, const glm::dvec3& place,
                                           bool toLines) const {
    const double reach =
        kSnapReach * view.metresPerPixel(glm::dot(place - view.camera().position, view.forward()));
    glm::dvec3 best = place;
    double least = reach;
    const auto offer = [&](const glm::dvec2& point) {
        const double away = glm::distance(point, glm::dvec2(place));
        if (away < least) {
            least = away;
            best = {point, place.z};
        }
    };
    for (const RouteGlyph& route : routes) {
        if (!toLines) {
            for (const glm::dvec3& handle : route.handles) {
                offer(glm::dvec2(handle));
            }
            continue;
        }
        for (std::size_t k = 1; k < route.line.size(); ++k) {
            const glm::dvec2 a(route.line[k - 1]), along = glm::dvec2(route.line[k]) - a;
            const double squared = glm::dot(along, along);
            if (squared > 0.0) {
                const double share = glm::dot(glm::dvec2(place) - a, along) / squared;
                offer(a + std::clamp(share, 0.0, 1.0) * along);
            }
        }
    }
    return best;
}

// ---- Drags

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
            return snappedToRoutes(view, place, true);
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
    place = snappedToRoutes(view, *place, false);
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
    Q_EMIT intents->clicked(picked ? std::optional(picked->item()) : std::nullopt, extend);
}

bool Viewport::Impl::cancelSomething() {
    if (drag) {
        endPress(true);
    } else if (!draft.empty()) {
        clearDraft();
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

// ---- Keys

void Viewport::Impl::walkInputChanged() {
    const auto held = [this](int a, int b) { return walkKeys.contains(a) || walkKeys.contains(b); };
    WalkInput input;
    input.ahead = double(held(Qt::Key_W, Qt::Key_Up)) - double(held(Qt::Key_S, Qt::Key_Down));
    input.sideways = double(walkKeys.contains(Qt::Key_D)) - double(walkKeys.contains(Qt::Key_A));
    input.turn = double(walkKeys.contains(Qt::Key_Left)) - double(walkKeys.contains(Qt::Key_Right));
    input.fast = walkFast;
    driver.setInput(input);
    startMotion();
}

bool Viewport::Impl::toolKey(int key) {
    switch (key) {
        case Qt::Key_Escape:
            return cancelSomething();
        case Qt::Key_Return:
        case Qt::Key_Enter:
            if (draft.size() >= 2) {
                changeTool(ViewportTool::Navigate, true);
                return true;
            }
            return false;
        case Qt::Key_Delete:
        case Qt::Key_Backspace:
            if (key == Qt::Key_Backspace && !draft.empty()) {
                draft.pop_back();
                rebuildOverlays(false);
                Q_EMIT intents->routeGrowing(int(draft.size()));
                return true;
            }
            if (hovered && hovered->kind == Picked::Kind::RouteHandle && !drag) {
                Q_EMIT intents->routePointRemoved(QString::fromStdString(hovered->id),
                                                  hovered->index);
                return true;
            }
            return false;
        default:
            return false;
    }
}

bool Viewport::Impl::navigateByKey(int key, bool shift) {
    const Camera from = driver.destination();
    const ViewGeometry view(from, double(q.width()), double(q.height()));
    const double distance = glm::distance(middleOfView(), from.position);
    const glm::dvec3 ahead = directionOf({headingOf(from).yaw, 0.0});
    const auto go = [&](const glm::dvec3& direction, double yaw, double pitch) {
        leaveFollowing();
        flyTo(shift ? orbited(from, middleOfView(), yaw, pitch)
                    : moved(from, kKeyMove * distance * direction));
    };
    const auto look = [&](const Heading& heading) {
        leaveFollowing();
        Camera about = from;
        about.target = middleOfView();
        flyTo(seenFrom(about, heading));
    };
    const double flat = std::clamp(headingOf(from).pitch, kSideSteepest, kSideFlattest);
    switch (key) {
        case Qt::Key_F:
            q.frameSelection();
            break;
        case Qt::Key_Home:
            q.frameAll();
            break;
        case Qt::Key_W:
            q.setWalking(true);
            break;
        case Qt::Key_1:
            look({0.5 * kPi, flat});
            break;
        case Qt::Key_3:
            look({kPi, flat});
            break;
        case Qt::Key_7:
            look({0.5 * kPi, -kSteepest});
            break;
        case Qt::Key_Left:
            go(-view.right(), kKeyTurn, 0.0);
            break;
        case Qt::Key_Right:
            go(view.right(), -kKeyTurn, 0.0);
            break;
        case Qt::Key_Up:
            go(ahead, 0.0, kKeyTurn);
            break;
        case Qt::Key_Down:
            go(-ahead, 0.0, -kKeyTurn);
            break;
        case Qt::Key_Plus:
        case Qt::Key_Equal:
            leaveFollowing();
            flyTo(zoomed(from, middleOfView(), kKeyZoom));
            break;
        case Qt::Key_Minus:
            leaveFollowing();
            flyTo(zoomed(from, middleOfView(), 1.0 / kKeyZoom));
            break;
        default:
            return false;
    }
    return true;
}

bool Viewport::Impl::wantsKey(int key) const {
    if (driver.walking() && (isWalkKey(key) || key == Qt::Key_Escape)) {
        return true;
    }
    switch (key) {
        case Qt::Key_Escape:
            return drag || tool != ViewportTool::Navigate || !state.followed.empty();
        case Qt::Key_Return:
        case Qt::Key_Enter:
            return draft.size() >= 2;
        case Qt::Key_Backspace:
            return !draft.empty() || (hovered && hovered->kind == Picked::Kind::RouteHandle);
        case Qt::Key_Delete:
            return hovered && hovered->kind == Picked::Kind::RouteHandle;
        default:
            return false;
    }
}

// ---- Events

bool Viewport::event(QEvent* event) {
    // What means something here and now is not a shortcut of the window.
    if (event->type() == QEvent::ShortcutOverride) {
        auto* key = static_cast<QKeyEvent*>(event);
        const bool plain = (key->modifiers() & (Qt::ControlModifier | Qt::AltModifier)) == 0;
        if (plain && m_impl->wantsKey(key->key())) {
            event->accept();
            return true;
        }
    }
    return QOpenGLWidget::event(event);
}

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
        const Pointer pointer{pixelOf(event->position()),
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
        const Ray ray = geometry().ray(pixelOf(event->position()));
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
        d.state.followOffset.distance =
            std::clamp(d.state.followOffset.distance * factor, kFollowNearest, kFollowFarthest);
        d.post(true);
        return;
    }
    d.driver.interrupt();
    d.applyCamera(zoomed(d.driver.camera(), d.pivotAt(event->position()), factor));
    d.hoverAt(event->position());
}

void Viewport::keyPressEvent(QKeyEvent* event) {
    Impl& d = *m_impl;
    const int key = event->key();
    constexpr auto others = Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier;
    const bool plain = (event->modifiers() & others) == 0;
    const bool shift = (event->modifiers() & Qt::ShiftModifier) != 0;
    if (plain && d.toolKey(key)) {
        return;
    }
    if (d.driver.walking() && (isWalkKey(key) || key == Qt::Key_Shift)) {
        d.walkFast = shift || key == Qt::Key_Shift;
        if (isWalkKey(key) && plain) {
            d.walkKeys.insert(key);
        }
        d.walkInputChanged();
        return;
    }
    if (plain && !event->isAutoRepeat() && key == Qt::Key_W && d.navigateByKey(key, shift)) {
        return;
    }
    if (!plain || key == Qt::Key_W || !d.navigateByKey(key, shift)) {
        QOpenGLWidget::keyPressEvent(event);
    }
}

void Viewport::keyReleaseEvent(QKeyEvent* event) {
    Impl& d = *m_impl;
    if (event->isAutoRepeat() || !d.driver.walking()) {
        QOpenGLWidget::keyReleaseEvent(event);
        return;
    }
    d.walkFast = (event->modifiers() & Qt::ShiftModifier) != 0 && event->key() != Qt::Key_Shift;
    d.walkKeys.remove(event->key());
    d.walkInputChanged();
}

void Viewport::leaveEvent(QEvent* event) {
    m_impl->hoverAt(std::nullopt);
    QOpenGLWidget::leaveEvent(event);
}

void Viewport::focusOutEvent(QFocusEvent* event) {
    // A key that is let go elsewhere would never be seen: nobody walks on without being told to.
    m_impl->walkKeys.clear();
    m_impl->walkInputChanged();
    QOpenGLWidget::focusOutEvent(event);
}

}  // namespace reflet
