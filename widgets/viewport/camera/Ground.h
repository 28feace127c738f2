// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"

#include <glm/vec2.hpp>

#include <memory>
#include <optional>

namespace reflet {

/// Height of a reflection probe that is put on a place, over what is there: about the middle of a
/// vehicle's body.
inline constexpr double kProbeHeight = 1.75;

/// What one can stand on and point at in a city, told from its heightfield. Without a city there is
/// a level ground at height 0. Project frame, metres.
class Ground {
public:
    Ground() = default;
    /// Without heightfield or tracer: as without a city.
    explicit Ground(std::shared_ptr<const DrawnCity> city);

    /// The terrain's height; NaN where there is none (outside the city).
    [[nodiscard]] double heightAt(double x, double y) const;
    /// The same, with the nearest terrain known within 50 m, else 0.
    [[nodiscard]] double heightNear(double x, double y) const;
    /// Whether something stands here that one cannot step on.
    [[nodiscard]] bool isSolid(double x, double y) const;

    /// The first thing that a ray meets, at most 20 km off: the city, else a level ground at the
    /// height of the city's lowest terrain. None for rays into the sky.
    [[nodiscard]] std::optional<glm::dvec3> pointUnder(const Ray& ray) const;
    /// A place on the terrain under the ray: where it meets a wall, that wall's foot.
    [[nodiscard]] std::optional<glm::dvec3> streetUnder(const Ray& ray) const;
    /// Where a new probe would go: over the street, before a wall, over a roof.
    [[nodiscard]] std::optional<glm::dvec3> probePlaceUnder(const Ray& ray) const;

    /// Where the city is; empty without one.
    [[nodiscard]] const Box& bounds() const { return m_bounds; }

private:
    std::shared_ptr<const DrawnCity> m_city;
    Box m_bounds;
    double m_floor = 0.0;  ///< the lowest terrain

    struct Hit {
        glm::dvec3 point{0.0};
        bool wall = false;
        double standing = 0.0;  ///< height of what one would stand on there
    };
    [[nodiscard]] std::optional<Hit> hit(const Ray& ray) const;
};

/// Where a point that is dragged along the ground comes to lie: under the ray, at `height` over the
/// terrain. Nothing when the ray never comes there.
[[nodiscard]] std::optional<glm::dvec3> draggedOverGround(const Ground& ground, const Ray& ray,
                                                          const glm::dvec3& from, double height);
/// The height at which the vertical line through `point` passes nearest to the ray.
[[nodiscard]] double draggedVertically(const Ray& ray, const glm::dvec3& point);

}  // namespace reflet
