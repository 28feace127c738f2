// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/viewport/camera/CameraMoves.h"
#include "widgets/viewport/input/PointerDrag.h"

#include <functional>
#include <utility>

namespace reflet {

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

/// Turns the camera about the vehicle that it goes along with.
class FollowDrag : public PointerDrag {
public:
    FollowDrag(const glm::dvec2& from, FollowOffset start,
               std::function<void(const FollowOffset&)> apply)
        : m_from(from), m_start(start), m_apply(std::move(apply)) {}

    void move(const ViewGeometry& view, const Pointer& pointer) override;
    void cancel() override { m_apply(m_start); }

private:
    glm::dvec2 m_from;
    FollowOffset m_start;
    std::function<void(const FollowOffset&)> m_apply;
};

/// As much nearer to the vehicle, or farther from it, within what is sensible.
[[nodiscard]] FollowOffset zoomedFollow(FollowOffset offset, double factor);

}  // namespace reflet
