// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/ViewIntents.h"
#include "widgets/viewport/camera/CameraMoves.h"
#include "widgets/viewport/camera/Ground.h"

#include <glm/vec2.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace reflet {

/// Where the mouse is, in pixels of the widget, and what is held down with it.
struct Pointer {
    glm::dvec2 pixel{0.0};
    bool shift = false;
    bool alt = false;
};

/// What goes on between pressing a mouse button and letting it go.
class PointerDrag {
public:
    PointerDrag() = default;
    virtual ~PointerDrag() = default;
    PointerDrag(const PointerDrag&) = delete;
    PointerDrag& operator=(const PointerDrag&) = delete;

    virtual void move(const ViewGeometry& view, const Pointer& pointer) = 0;
    virtual void end() {}
    virtual void cancel() {}
};

/// Moves the camera: from where it was at the start, by how far the mouse has come since.
class CameraDrag : public PointerDrag {
public:
    /// how: the new camera, for the picture at the start and the mouse there and now.
    using Move = std::function<Camera(const ViewGeometry& start, const glm::dvec2& from,
                                      const glm::dvec2& to)>;
    CameraDrag(const ViewGeometry& start, const glm::dvec2& from, Move how,
               std::function<void(const Camera&)> apply)
        : m_start(start), m_from(from), m_how(std::move(how)), m_apply(std::move(apply)) {}

    void move(const ViewGeometry& /*view*/, const Pointer& pointer) override {
        m_apply(m_how(m_start, m_from, pointer.pixel));
    }
    void cancel() override { m_apply(m_start.camera()); }

private:
    ViewGeometry m_start;
    glm::dvec2 m_from;
    Move m_how;
    std::function<void(const Camera&)> m_apply;
};

/// How a camera drag turns and moves. Radians per pixel are the same for all sizes of the window.
namespace drags {
[[nodiscard]] CameraDrag::Move orbit(const glm::dvec3& pivot);
[[nodiscard]] CameraDrag::Move pan(const glm::dvec3& grabbed);
[[nodiscard]] CameraDrag::Move look();
/// Angles for a movement of the mouse as when the scene is turned by hand: (yaw, pitch).
[[nodiscard]] glm::dvec2 turnFor(const glm::dvec2& movement);
}  // namespace drags

/// Drags a point over the ground, at the height over it that it had; with Shift up and down. Tells
/// each step as ViewIntents.h says. The point stays under the mouse where it was grabbed.
class PointDrag : public PointerDrag {
public:
    using Tell = std::function<void(const glm::dvec3&, DragPhase)>;
    /// Pulls a place to something near it; called unless Alt is held.
    using Snap = std::function<glm::dvec3(const ViewGeometry&, const glm::dvec3&)>;

    PointDrag(const ViewGeometry& view, const glm::dvec2& pressed, const glm::dvec3& point,
              std::shared_ptr<const Ground> ground, Tell tell, Snap snap);

    void move(const ViewGeometry& view, const Pointer& pointer) override;
    void end() override;
    void cancel() override;

private:
    std::shared_ptr<const Ground> m_ground;
    Tell m_tell;
    Snap m_snap;
    glm::dvec3 m_before;  ///< the point at the start
    glm::dvec3 m_point;
    double m_height;       ///< over the ground
    glm::dvec2 m_grabbed;  ///< pixels from the point to where it was grabbed
    bool m_begun = false;
};

}  // namespace reflet
