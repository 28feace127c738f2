// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/camera/ViewGeometry.h"

#include "widgets/viewport/camera/CameraMoves.h"

#include <algorithm>
#include <cmath>

namespace reflet {

ViewGeometry::ViewGeometry(const Camera& camera, double width, double height)
    : m_camera(upright(camera)),
      m_width(std::max(width, 1.0)),
      m_height(std::max(height, 1.0)),
      m_tangent(std::tan(0.5 * m_camera.verticalFov)),
      m_forward(glm::normalize(m_camera.target - m_camera.position)),
      m_right(glm::normalize(glm::cross(m_forward, glm::dvec3(0.0, 0.0, 1.0)))),
      m_up(glm::cross(m_right, m_forward)) {}

Ray ViewGeometry::ray(const glm::dvec2& pixel) const {
    const double x = (2.0 * pixel.x - m_width) / m_height * m_tangent;
    const double y = (m_height - 2.0 * pixel.y) / m_height * m_tangent;
    return {m_camera.position, glm::normalize(m_forward + x * m_right + y * m_up)};
}

ProjectedPoint ViewGeometry::project(const glm::dvec3& point) const {
    const glm::dvec3 offset = point - m_camera.position;
    const double depth = glm::dot(offset, m_forward);
    if (!(depth > 0.0)) {
        return {{0.0, 0.0}, std::min(depth, 0.0)};
    }
    const double scale = 0.5 * m_height / (m_tangent * depth);
    return {{0.5 * m_width + glm::dot(offset, m_right) * scale,
             0.5 * m_height - glm::dot(offset, m_up) * scale},
            depth};
}

double ViewGeometry::metresPerPixel(double depth) const {
    return 2.0 * m_tangent * depth / m_height;
}

}  // namespace reflet
