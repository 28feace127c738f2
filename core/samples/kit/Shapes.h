// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Mesh.h"

#include <span>

namespace reflet::kit {

/// An axis-aligned rectangle in the plan, metres, x0 < x1 and y0 < y1.
struct Plot {
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;

    [[nodiscard]] double width() const { return x1 - x0; }
    [[nodiscard]] double depth() const { return y1 - y0; }
    [[nodiscard]] glm::dvec2 center() const { return {0.5 * (x0 + x1), 0.5 * (y0 + y1)}; }
    [[nodiscard]] Plot grown(double by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
    [[nodiscard]] bool contains(double x, double y) const {
        return x >= x0 && x <= x1 && y >= y0 && y <= y1;
    }
};

/// Position and heading of a thing on the ground: local x forward, y left, z up.
struct Stand {
    glm::dvec3 origin{0.0};
    glm::dvec2 forward{1.0, 0.0};  ///< unit

    [[nodiscard]] glm::dvec3 at(double x, double y, double z) const {
        return origin + glm::dvec3(x * forward.x - y * forward.y, x * forward.y + y * forward.x, z);
    }
};

/// Level rectangle facing up.
void slab(Mesh& mesh, const Plot& plot, double z, Skin skin);
/// Upright faces around the plot, and a lid; no floor.
void block(Mesh& mesh, const Plot& plot, double z0, double z1, Skin sides, Skin lid);
/// A box in the frame of a stand, from low to high corner, all six faces or five without the floor.
void box(Mesh& mesh, const Stand& stand, const glm::dvec3& low, const glm::dvec3& high, Skin skin,
         bool withFloor = true);
/// An upright prism over a counter-clockwise outline, with a lid.
void prism(Mesh& mesh, std::span<const glm::dvec2> outline, double z0, double z1, Skin sides,
           Skin lid);
/// Round bar between two points, open at the ends; radii may differ.
void bar(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double radiusFrom,
         double radiusTo, int sides, Skin skin);
/// Surface of revolution about the upright line through `foot`; profile points are (radius,
/// height above foot) from below to above.
void lathe(Mesh& mesh, const glm::dvec3& foot, std::span<const glm::dvec2> profile, int sides,
           Skin skin);
inline void lathe(Mesh& mesh, const glm::dvec3& foot, std::initializer_list<glm::dvec2> profile,
                  int sides, Skin skin) {
    lathe(mesh, foot, std::span<const glm::dvec2>(profile.begin(), profile.size()), sides, skin);
}
/// Level regular polygon facing up.
void disc(Mesh& mesh, const glm::dvec3& center, double radius, int sides, Skin skin);

}  // namespace reflet::kit
