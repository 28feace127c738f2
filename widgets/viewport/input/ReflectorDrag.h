// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/ViewIntents.h"
#include "widgets/viewport/input/PointerDrag.h"

#include <glm/vec3.hpp>

#include <functional>
#include <vector>

namespace reflet {

/// Tells which station of its route a vehicle is dragged to: the one nearest to the place under the
/// mouse, at the height of the vehicle.
class ReflectorDrag : public PointerDrag {
public:
    /// Metres along the route, of the vehicle's middle.
    using Tell = std::function<void(double, DragPhase)>;
    /// line: the route; grabbed: where the vehicle was, which stands at station.
    ReflectorDrag(std::vector<glm::dvec3> line, const glm::dvec3& grabbed, double station,
                  Tell tell);

    void move(const ViewGeometry& view, const Pointer& pointer) override;
    void end() override;
    void cancel() override;

private:
    std::vector<glm::dvec3> m_line;
    double m_height;
    double m_before;
    double m_station;
    double m_offset;  ///< from where it was grabbed to its middle
    Tell m_tell;
    bool m_begun = false;
};

}  // namespace reflet
