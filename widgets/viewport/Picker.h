// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/project/ProjectItem.h"
#include "widgets/viewport/camera/ViewGeometry.h"

#include <glm/vec2.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// A vehicle where it stands, as boxes around its bodies that turn with them.
struct BoxedReflector {
    struct Body {
        RigidTransform project_from_body;
        Box box;  ///< body frame
    };
    std::string id;
    std::vector<Body> bodies;

    /// Around all of it, project frame.
    [[nodiscard]] Box bounds() const;
    /// Where a ray (unit direction) enters it; 0 from inside.
    [[nodiscard]] std::optional<double> hit(const Ray& ray) const;
};

/// Boxes vehicles in; remembers the boxes of vehicles that it has seen.
class ReflectorBoxes {
public:
    [[nodiscard]] BoxedReflector boxed(const PlacedReflector& reflector);
    [[nodiscard]] std::vector<BoxedReflector> boxed(const std::vector<PlacedReflector>& reflectors);
    void forget() { m_boxes.clear(); }

private:
    std::map<std::shared_ptr<const Vehicle>, std::vector<Box>> m_boxes;
};

/// What lies under the mouse.
struct Picked {
    enum class Kind { Probe, RouteHandle, RouteLine, Reflector };
    Kind kind = Kind::Probe;
    std::string id;
    int index = 0;  ///< of the handle; for a line, of the handle before which a new one goes
    glm::dvec3 point{0.0};  ///< the probe's or handle's place, else where the line or body was met
    double pixels = 0.0;    ///< from the mouse; 0 inside a body
    double depth = 0.0;     ///< metres along the viewing direction

    [[nodiscard]] ProjectItem item() const;
    friend bool operator==(const Picked&, const Picked&) = default;
};

/// Everything that can be picked, project frame.
struct Pickable {
    const std::vector<ProbeGlyph>* probes = nullptr;  ///< none of the pointers is null
    const std::vector<RouteGlyph>* routes = nullptr;
    const std::vector<BoxedReflector>* reflectors = nullptr;
};

/// What a click at a pixel means: small things first (corners of selected routes, probes; of
/// several the one nearest to the mouse, then to the viewer), then vehicles, then routes. `reach`:
/// pixels that a click may miss small things by.
[[nodiscard]] std::optional<Picked> pick(const ViewGeometry& view, const Pickable& things,
                                         const glm::dvec2& pixel, double reach);

/// Distance along a polyline, in the plan, of its point that is nearest to a place (in the plan).
[[nodiscard]] double nearestStation(const std::vector<glm::dvec3>& line, const glm::dvec3& place);

}  // namespace reflet
