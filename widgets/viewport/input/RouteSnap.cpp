// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/input/RouteSnap.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>

namespace reflet {

namespace {

constexpr double kReach = 9.0;  // pixels

/// Of the points that it is offered the one nearest to a place, within reach.
class Nearest {
public:
    Nearest(const ViewGeometry& view, const glm::dvec3& place)
        : m_place(place),
          m_best(place),
          m_least(kReach *
                  view.metresPerPixel(glm::dot(place - view.camera().position, view.forward()))) {}

    void offer(const glm::dvec2& point) {
        const double away = glm::distance(point, glm::dvec2(m_place));
        if (away < m_least) {
            m_least = away;
            m_best = {point, m_place.z};
        }
    }
    [[nodiscard]] const glm::dvec3& best() const { return m_best; }

private:
    glm::dvec3 m_place;
    glm::dvec3 m_best;
    double m_least;
};

}  // namespace

glm::dvec3 snappedToCorners(const std::vector<RouteGlyph>& routes, const ViewGeometry& view,
                            const glm::dvec3& place) {
    Nearest nearest(view, place);
    for (const RouteGlyph& route : routes) {
        for (const glm::dvec3& handle : route.handles) {
            nearest.offer(glm::dvec2(handle));
        }
    }
    return nearest.best();
}

glm::dvec3 snappedToLines(const std::vector<RouteGlyph>& routes, const ViewGeometry& view,
                          const glm::dvec3& place) {
    Nearest nearest(view, place);
    for (const RouteGlyph& route : routes) {
        for (std::size_t k = 1; k < route.line.size(); ++k) {
            const glm::dvec2 a(route.line[k - 1]), along = glm::dvec2(route.line[k]) - a;
            const double squared = glm::dot(along, along);
            if (squared > 0.0) {
                const double share = glm::dot(glm::dvec2(place) - a, along) / squared;
                nearest.offer(a + std::clamp(share, 0.0, 1.0) * along);
            }
        }
    }
    return nearest.best();
}

}  // namespace reflet
