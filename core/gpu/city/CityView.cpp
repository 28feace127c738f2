// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityView.h"

#include "core/environment/CubeDirection.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {

glm::mat4 CityView::clip_from_eye() const {
    const glm::vec3 x = right / tanHalf.x;
    const glm::vec3 y = up / tanHalf.y;
    // Rows are x, y, (0 0 0 near), forward; glm stores columns.
    return glm::transpose(glm::mat4(glm::vec4(x, 0.0F), glm::vec4(y, 0.0F),
                                    glm::vec4(0.0F, 0.0F, 0.0F, near), glm::vec4(forward, 0.0F)));
}

glm::mat4 CityView::clip_from_project() const {
    return clip_from_eye() * glm::translate(glm::mat4(1.0F), -glm::vec3(eye));
}

float CityView::pixelsPerRadian() const {
    return 0.5F * float(height) / tanHalf.y;
}

CityView cityView(const Camera& camera, int width, int height) {
    CityView view;
    view.eye = camera.position;
    view.width = std::max(width, 1);
    view.height = std::max(height, 1);
    const glm::dvec3 ahead = camera.target - camera.position;
    const glm::dvec3 forward =
        glm::length(ahead) > 0.0 ? glm::normalize(ahead) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 side = glm::cross(forward, glm::dvec3(0.0, 0.0, 1.0));
    const glm::dvec3 right =
        glm::length(side) > 1e-9 ? glm::normalize(side) : glm::dvec3(1.0, 0.0, 0.0);
    view.forward = glm::vec3(forward);
    view.right = glm::vec3(right);
    view.up = glm::vec3(glm::cross(right, forward));
    const double half = std::tan(0.5 * camera.verticalFov);
    view.tanHalf = glm::vec2(half * double(view.width) / double(view.height), half);
    return view;
}

CityView cityFaceView(const glm::dvec3& center, int face, int edge) {
    CityView view;
    view.eye = center;
    view.width = view.height = std::max(edge, 1);
    const glm::dvec3 axis = faceDirection(face, {0.0, 0.0});
    view.forward = glm::vec3(axis);
    view.right = glm::vec3(faceDirection(face, {1.0, 0.0}) - axis);
    view.up = glm::vec3(faceDirection(face, {0.0, 1.0}) - axis);
    view.tanHalf = glm::vec2(1.0F);
    view.spread = float(0.5 * kPi / view.width);
    return view;
}

}  // namespace reflet
