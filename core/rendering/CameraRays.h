// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/rendering/ViewRenderer.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <optional>

namespace reflet {

/// The rays of a pinhole camera. Pixel (x, y) counts from the picture's upper left corner; the
/// centre of the first pixel is (0.5, 0.5). A camera that looks straight up or down has east right.
class CameraRays {
public:
    CameraRays(const Camera& camera, int width, int height) : m_width(width), m_height(height) {
        m_position = camera.position;
        m_forward = glm::normalize(camera.target - camera.position);
        const glm::dvec3 side = glm::cross(m_forward, glm::dvec3(0, 0, 1));
        m_right = glm::length(side) > 1e-9 ? glm::normalize(side) : glm::dvec3(1, 0, 0);
        m_up = glm::cross(m_right, m_forward);
        m_halfHeight = std::tan(0.5 * camera.verticalFov);
    }

    /// Unit direction through a point of the picture.
    [[nodiscard]] glm::dvec3 through(double x, double y) const {
        const double unit = 2.0 * m_halfHeight / m_height;
        return glm::normalize(m_forward + m_right * ((x - 0.5 * m_width) * unit) +
                              m_up * ((0.5 * m_height - y) * unit));
    }

    /// Where a point of the project frame falls in the picture; nothing behind the camera.
    [[nodiscard]] std::optional<glm::dvec2> project(const glm::dvec3& point) const {
        const glm::dvec3 d = point - m_position;
        const double depth = glm::dot(d, m_forward);
        if (depth <= 0.0) {
            return std::nullopt;
        }
        const double unit = 2.0 * m_halfHeight / m_height;
        return glm::dvec2(0.5 * m_width + glm::dot(d, m_right) / (depth * unit),
                          0.5 * m_height - glm::dot(d, m_up) / (depth * unit));
    }

    [[nodiscard]] const glm::dvec3& position() const { return m_position; }

private:
    int m_width;
    int m_height;
    glm::dvec3 m_position, m_forward, m_right, m_up;
    double m_halfHeight;
};

}  // namespace reflet
