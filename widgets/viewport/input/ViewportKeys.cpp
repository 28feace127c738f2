// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of the viewport.
#include "widgets/viewport/ViewportImpl.h"

#include <QKeyEvent>
#include <algorithm>

namespace reflet {

namespace {

constexpr double kKeyMove = 0.1;  // of the distance to what is looked at
constexpr double kKeyTurn = 8.0 / 180.0 * kPi;
constexpr double kKeyZoom = 0.8;
constexpr double kSideSteepest = -0.6, kSideFlattest = -0.15;  // radians: a view from a side

/// Keys with which one walks.
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

}  // namespace

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
            return drag || tool != ViewportTool::Navigate || !state.followed.empty() ||
                   !q.markedObject().isEmpty();
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
    return QWidget::event(event);
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
        QWidget::keyPressEvent(event);
    }
}

void Viewport::keyReleaseEvent(QKeyEvent* event) {
    Impl& d = *m_impl;
    if (event->isAutoRepeat() || !d.driver.walking()) {
        QWidget::keyReleaseEvent(event);
        return;
    }
    d.walkFast = (event->modifiers() & Qt::ShiftModifier) != 0 && event->key() != Qt::Key_Shift;
    d.walkKeys.remove(event->key());
    d.walkInputChanged();
}

void Viewport::focusOutEvent(QFocusEvent* event) {
    // A key that is let go elsewhere would never be seen: nobody walks on without being told to.
    m_impl->walkKeys.clear();
    m_impl->walkInputChanged();
    QWidget::focusOutEvent(event);
}

}  // namespace reflet
