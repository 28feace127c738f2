// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace reflet {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A half-line in the project frame. `direction` need not have unit length unless said.
struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0};

    [[nodiscard]] glm::dvec3 at(double t) const { return origin + t * direction; }
};

/// An axis-aligned box; empty until something is added.
struct Box {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void add(const Box& b) {
        min = glm::min(min, b.min);
        max = glm::max(max, b.max);
    }
    [[nodiscard]] bool empty() const { return !(min.x <= max.x); }
    [[nodiscard]] glm::dvec3 size() const { return empty() ? glm::dvec3(0.0) : max - min; }
    [[nodiscard]] glm::dvec3 center() const { return 0.5 * (min + max); }
};

}  // namespace reflet
