// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/ViewIntents.h"
#include "widgets/viewport/camera/Ground.h"
#include "widgets/viewport/input/PointerDrag.h"

#include <functional>
#include <memory>

namespace reflet {

/// Drags a point over the ground, at the height over it that it had; with Shift up and down. Tells
/// each step as DragPhase says. The point stays under the mouse where it was grabbed.
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
