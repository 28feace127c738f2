// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec2.hpp>

#include <initializer_list>
#include <utility>
#include <vector>

namespace reflet {

/// Signed distance (negative inside) to a rectangle with rounded corners, edges at lo and hi.
[[nodiscard]] float roundedRectangle(const glm::vec2& p, const glm::vec2& lo, const glm::vec2& hi,
                                     float radius);

/// A polygon whose corners are rounded: its outline is the polygon's own, corners cut by arcs.
/// Signed distance, negative inside (from half a metre outside on, a lower bound); convex or not,
/// either orientation.
class RoundedPolygon {
public:
    RoundedPolygon(std::vector<glm::vec2> corners, float radius);
    [[nodiscard]] float distance(const glm::vec2& p) const;

private:
    std::vector<glm::vec2> m_outline;
    std::vector<float> m_inverse;  // 1 / squared length of the edge from each point to the last
    glm::vec2 m_low{0.0F};
    glm::vec2 m_high{0.0F};
};

/// A smooth curve y(x) through knots of growing x (monotone cubic, Fritsch & Carlson 1980: no
/// overshoot), constant beyond the ends.
class Curve {
public:
    Curve(std::initializer_list<std::pair<float, float>> knots);
    [[nodiscard]] float operator()(float x) const;

private:
    std::vector<float> m_x, m_y, m_slope;
};

/// An open polyline with corners rounded by arcs of `radius` (shortened where there is no room),
/// resampled so that no step exceeds `step` and arcs have at least `arcSteps` steps.
struct PathCorner {
    glm::vec2 point{0.0F};
    float radius = 0.0F;
};
[[nodiscard]] std::vector<glm::vec2> roundedPath(const std::vector<PathCorner>& corners, float step,
                                                 int arcSteps);

}  // namespace reflet
