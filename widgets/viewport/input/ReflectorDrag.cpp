// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/input/ReflectorDrag.h"

#include "widgets/viewport/Picker.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet {

ReflectorDrag::ReflectorDrag(std::vector<glm::dvec3> line, const glm::dvec3& grabbed,
                             double station, Tell tell)
    : m_line(std::move(line)),
      m_height(grabbed.z),
      m_before(station),
      m_station(station),
      m_offset(station - nearestStation(m_line, grabbed)),
      m_tell(std::move(tell)) {}

void ReflectorDrag::move(const ViewGeometry& view, const Pointer& pointer) {
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

void ReflectorDrag::end() {
    if (m_begun) {
        m_tell(m_station, DragPhase::End);
    }
}

void ReflectorDrag::cancel() {
    if (m_begun) {
        m_tell(m_before, DragPhase::Cancel);
    }
}

}  // namespace reflet
