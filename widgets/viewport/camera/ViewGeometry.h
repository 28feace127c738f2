// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"
#include "core/rendering/ViewRenderer.h"

#include <glm/vec2.hpp>

namespace reflet {

/// A point of the scene in a picture.
struct ProjectedPoint {
    glm::dvec2 pixel{0.0};
    double depth = 0.0;  ///< metres along the viewing direction; > 0: in front of the camera
};

/// Where things of the scene lie in a picture of it. Pixels are continuous, (0, 0) is the top left
/// corner of the picture, y grows downwards; project frame, metres. Never gives NaN: a camera that
/// looks nowhere looks north, a picture without size has one pixel.
class ViewGeometry {
public:
    ViewGeometry(const Camera& camera, double width, double height);

    [[nodiscard]] const Camera& camera() const { return m_camera; }
    [[nodiscard]] double width() const { return m_width; }
    [[nodiscard]] double height() const { return m_height; }
    /// Unit vectors: the viewing direction, and right and up in the picture; right is level.
    [[nodiscard]] const glm::dvec3& forward() const { return m_forward; }
    [[nodiscard]] const glm::dvec3& right() const { return m_right; }
    [[nodiscard]] const glm::dvec3& up() const { return m_up; }

    /// From the camera through a pixel, direction of unit length.
    [[nodiscard]] Ray ray(const glm::dvec2& pixel) const;
    /// Points in the camera's plane or behind it have a depth <= 0, and their pixel means nothing.
    [[nodiscard]] ProjectedPoint project(const glm::dvec3& point) const;
    /// Length that one pixel spans at a depth.
    [[nodiscard]] double metresPerPixel(double depth) const;

private:
    Camera m_camera;
    double m_width;
    double m_height;
    double m_tangent;  ///< of half the vertical field of view
    glm::dvec3 m_forward, m_right, m_up;
};

}  // namespace reflet
