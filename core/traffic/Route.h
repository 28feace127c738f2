// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Transform.h"

#include <vector>

namespace reflet {

/// A polyline that a reflector drives, parametrised by the distance along it in the plan.
/// Corners are rounded with arcs where the caller asked for it (see smoothed()).
class Route {
public:
    /// points: at least two distinct ones, project frame, z = height of the running surface.
    explicit Route(std::vector<glm::dvec3> points);

    [[nodiscard]] double length() const { return m_length; }
    [[nodiscard]] const std::vector<glm::dvec3>& points() const { return m_points; }
    /// The point at distance s from the start, clamped to the ends.
    [[nodiscard]] glm::dvec3 at(double s) const;
    /// Unit tangent in the plan at s.
    [[nodiscard]] glm::dvec3 tangent(double s) const;
    /// The same route with corners rounded to at most `radius` metres, sampled every half metre.
    [[nodiscard]] Route smoothed(double radius) const;
    /// Evenly spaced distances 0, step', 2 step' ... length with step' <= step.
    [[nodiscard]] std::vector<double> stations(double step) const;

private:
    std::vector<glm::dvec3> m_points;
    std::vector<double> m_distance;
    double m_length = 0.0;
};

}  // namespace reflet
