// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace reflet {

/// Rings as indices into one list of points, without repeated and closing points.
using IndexRings = std::vector<std::vector<std::uint32_t>>;

/// An area below this share of the perimeter squared is rounding error.
inline constexpr double kVanishingArea = 1e-14;

/// The plane that a polygon is taken to lie in.
struct PolygonPlane {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0, 0.0,
                      1.0};  ///< unit length; the outer ring runs counter-clockwise about it

    [[nodiscard]] double distance(const glm::dvec3& p) const;
};

/// Twice the vector area of a ring (Newell's normal): right for every planar ring, concave too,
/// and zero for one whose parts cancel each other, like a bow-tie.
struct RingNormal {
    glm::dvec3 area{0.0};
    double perimeter = 0.0;

    [[nodiscard]] bool vanishes() const;
};
[[nodiscard]] RingNormal ringNormal(const std::vector<glm::dvec3>& points,
                                    const std::vector<std::uint32_t>& ring);

/// The plane by the outer ring's normal; where that nearly vanishes (a bow-tie has none, a sliver
/// hardly any) the least-squares plane of all points competes, and the one that lies closer to
/// them wins. nullopt when neither exists.
[[nodiscard]] std::optional<PolygonPlane> fitPlane(const std::vector<glm::dvec3>& points,
                                                   const IndexRings& rings);

/// Greatest distance of a ring's point from the plane, in metres.
[[nodiscard]] double planeDeviation(const PolygonPlane& plane,
                                    const std::vector<glm::dvec3>& points, const IndexRings& rings);

/// Two coordinates by dropping the axis along which the normal is longest: they stay exact, and a
/// ring that is counter-clockwise about the normal stays so.
class DominantAxis {
public:
    explicit DominantAxis(const glm::dvec3& normal) {
        const glm::dvec3 size = glm::abs(normal);
        const int axis = size.z >= size.x && size.z >= size.y ? 2 : (size.x >= size.y ? 0 : 1);
        m_u = (axis + 1) % 3;
        m_v = (axis + 2) % 3;
        m_w = axis;
        if (normal[axis] < 0.0)
            std::swap(m_u, m_v);
    }
    [[nodiscard]] glm::dvec2 project(const glm::dvec3& p) const { return {p[m_u], p[m_v]}; }
    /// The point of the plane over (u, v).
    [[nodiscard]] glm::dvec3 lift(double u, double v, const PolygonPlane& plane) const;

private:
    int m_u = 0;
    int m_v = 1;
    int m_w = 2;
};

}  // namespace reflet
