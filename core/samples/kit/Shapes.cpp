// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Shapes.h"

#include <cmath>

namespace reflet::kit {

namespace {

glm::dvec2 onCircle(int i, int sides) {
    const double angle = 2.0 * kPi * (i + 0.5) / sides;
    return {std::cos(angle), std::sin(angle)};
}

}  // namespace

void slab(Mesh& mesh, const Plot& p, double z, Skin skin) {
    mesh.polygon({{p.x0, p.y0, z}, {p.x1, p.y0, z}, {p.x1, p.y1, z}, {p.x0, p.y1, z}}, skin);
}

void block(Mesh& mesh, const Plot& p, double z0, double z1, Skin sides, Skin lid) {
    const std::array<glm::dvec2, 4> outline{
        {{p.x0, p.y0}, {p.x1, p.y0}, {p.x1, p.y1}, {p.x0, p.y1}}};
    prism(mesh, outline, z0, z1, sides, lid);
}

void box(Mesh& mesh, const Stand& s, const glm::dvec3& a, const glm::dvec3& b, Skin skin,
         bool withFloor) {
    const auto p = [&](int i) {
        return s.at((i & 1) != 0 ? b.x : a.x, (i & 2) != 0 ? b.y : a.y, (i & 4) != 0 ? b.z : a.z);
    };
    mesh.polygon({p(0), p(1), p(5), p(4)}, skin);
    mesh.polygon({p(1), p(3), p(7), p(5)}, skin);
    mesh.polygon({p(3), p(2), p(6), p(7)}, skin);
    mesh.polygon({p(2), p(0), p(4), p(6)}, skin);
    mesh.polygon({p(4), p(5), p(7), p(6)}, skin);
    if (withFloor) {
        mesh.polygon({p(0), p(2), p(3), p(1)}, skin);
    }
}

void prism(Mesh& mesh, std::span<const glm::dvec2> outline, double z0, double z1, Skin sides,
           Skin lid) {
    std::vector<glm::dvec3> top;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2& a = outline[i];
        const glm::dvec2& b = outline[(i + 1) % outline.size()];
        mesh.polygon({{a, z0}, {b, z0}, {b, z1}, {a, z1}}, sides);
        top.emplace_back(a, z1);
    }
    mesh.polygon(top, lid);
}

void bar(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double r0, double r1, int sides,
         Skin skin) {
    const glm::dvec3 axis = glm::normalize(to - from);
    const glm::dvec3 helper = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(helper, axis));
    const glm::dvec3 v = glm::cross(axis, u);
    for (int i = 0; i < sides; ++i) {
        const glm::dvec2 a = onCircle(i, sides);
        const glm::dvec2 b = onCircle(i + 1, sides);
        const glm::dvec3 da = a.x * u + a.y * v;
        const glm::dvec3 db = b.x * u + b.y * v;
        mesh.polygon({from + r0 * da, from + r0 * db, to + r1 * db, to + r1 * da}, skin);
    }
}

void lathe(Mesh& mesh, const glm::dvec3& foot, std::span<const glm::dvec2> profile, int sides,
           Skin skin) {
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
        for (int i = 0; i < sides; ++i) {
            const glm::dvec2 a = onCircle(i, sides);
            const glm::dvec2 b = onCircle(i + 1, sides);
            const auto point = [&](const glm::dvec2& around, const glm::dvec2& p) {
                return foot + glm::dvec3(around * p.x, p.y);
            };
            mesh.polygon({point(a, profile[k]), point(b, profile[k]), point(b, profile[k + 1]),
                          point(a, profile[k + 1])},
                         skin);
        }
    }
}

void disc(Mesh& mesh, const glm::dvec3& center, double radius, int sides, Skin skin) {
    std::vector<glm::dvec3> ring;
    for (int i = 0; i < sides; ++i) {
        ring.push_back(center + glm::dvec3(radius * onCircle(i, sides), 0.0));
    }
    mesh.polygon(ring, skin);
}

}  // namespace reflet::kit
