// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/input/PointDrag.h"

#include <algorithm>

namespace reflet {

namespace {

constexpr double kDeepest = 0.05;  // metres over the ground: no point is dragged into it

}  // namespace

PointDrag::PointDrag(const ViewGeometry& view, const glm::dvec2& pressed, const glm::dvec3& point,
                     std::shared_ptr<const Ground> ground, Tell tell, Snap snap)
    : m_ground(std::move(ground)),
      m_tell(std::move(tell)),
      m_snap(std::move(snap)),
      m_before(point),
      m_point(point),
      m_height(point.z - m_ground->heightNear(point.x, point.y)),
      m_grabbed(pressed - view.project(point).pixel) {}

void PointDrag::move(const ViewGeometry& view, const Pointer& pointer) {
    const Ray ray = view.ray(pointer.pixel - m_grabbed);
    glm::dvec3 place = m_point;
    if (pointer.shift) {
        const double floor = m_ground->heightNear(m_point.x, m_point.y) + kDeepest;
        place.z = std::max(floor, draggedVertically(ray, m_point));
        m_height = place.z - (floor - kDeepest);
    } else if (const auto dragged = draggedOverGround(*m_ground, ray, m_point, m_height)) {
        place = *dragged;
        if (!pointer.alt && m_snap) {
            place = m_snap(view, place);
        }
    }
    if (place == m_point) {
        return;
    }
    m_point = place;
    m_tell(m_point, m_begun ? DragPhase::Move : DragPhase::Begin);
    m_begun = true;
}

void PointDrag::end() {
    if (m_begun) {
        m_tell(m_point, DragPhase::End);
    }
}

void PointDrag::cancel() {
    if (m_begun) {
        m_tell(m_before, DragPhase::Cancel);
    }
}

}  // namespace reflet
