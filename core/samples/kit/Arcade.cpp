// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Arcade.h"

#include "core/samples/kit/ShopFront.h"

#include <algorithm>
#include <cmath>

namespace reflet::kit {

namespace {

constexpr int kArcSegments = 18;

/// One bay's arch in the façade's plane.
struct Arch {
    double center = 0.0;
    double radius = 0.0;
    double springing = 0.0;

    /// i = 0 at the left springing, kArcSegments at the right one.
    [[nodiscard]] glm::dvec2 at(int i, double r) const {
        const double angle = kPi * (1.0 - double(i) / kArcSegments);
        return {center + r * std::cos(angle), springing + r * std::sin(angle)};
    }
};

void spandrel(Mesh& mesh, const Facade& f, const Arch& arch, double u0, double u1, double top,
              double w, bool front, Skin skin) {
    std::vector<glm::dvec3> ring{f.at(u0, arch.springing, w)};
    for (int i = 0; i <= kArcSegments; ++i) {
        const glm::dvec2 p = arch.at(i, arch.radius);
        ring.push_back(f.at(p.x, p.y, w));
    }
    ring.push_back(f.at(u1, arch.springing, w));
    ring.push_back(f.at(u1, top, w));
    ring.push_back(f.at(u0, top, w));
    if (!front) {
        ring = {ring.rbegin(), ring.rend()};
    }
    mesh.polygon(ring, skin);
}

void soffit(Mesh& mesh, const Facade& f, const Arch& arch, double thickness, Skin skin) {
    const auto strip = [&](const glm::dvec2& a, const glm::dvec2& b) {
        mesh.polygon({f.at(a.x, a.y, -thickness), f.at(b.x, b.y, -thickness), f.at(b.x, b.y, 0),
                      f.at(a.x, a.y, 0)},
                     skin);
    };
    const double left = arch.center - arch.radius, right = arch.center + arch.radius;
    strip({left, 0}, {left, arch.springing});
    for (int i = 0; i < kArcSegments; ++i) {
        strip(arch.at(i, arch.radius), arch.at(i + 1, arch.radius));
    }
    strip({right, arch.springing}, {right, 0});
}

void archivolt(Mesh& mesh, const Facade& f, const Arch& arch, Skin skin) {
    constexpr double kOut = 0.07;
    constexpr double kWide = 0.3;
    for (int i = 0; i < kArcSegments; ++i) {
        const glm::dvec2 a = arch.at(i, arch.radius), b = arch.at(i + 1, arch.radius);
        const glm::dvec2 c = arch.at(i + 1, arch.radius + kWide),
                         d = arch.at(i, arch.radius + kWide);
        mesh.polygon({f.at(a.x, a.y, kOut), f.at(b.x, b.y, kOut), f.at(c.x, c.y, kOut),
                      f.at(d.x, d.y, kOut)},
                     skin);
        mesh.polygon(
            {f.at(d.x, d.y, kOut), f.at(c.x, c.y, kOut), f.at(c.x, c.y, 0), f.at(d.x, d.y, 0)},
            skin);
        mesh.polygon(
            {f.at(a.x, a.y, 0), f.at(b.x, b.y, 0), f.at(b.x, b.y, kOut), f.at(a.x, a.y, kOut)},
            skin);
    }
    const double crown = arch.springing + arch.radius;
    relief(mesh, f, {arch.center - 0.17, arch.center + 0.17, crown - 0.04, crown + 0.5}, 0, 0.15,
           skin);
}

void pier(Mesh& mesh, const Facade& f, double u0, double u1, const ArcadeStyle& style) {
    const Skin wall{style.wall, SurfaceType::Wall};
    const Skin trim{style.trim, SurfaceType::Wall};
    panel(mesh, f, {u0, u1, 0, style.springing}, 0, wall);
    mesh.polygon(
        {f.at(u1, 0, -style.thickness), f.at(u0, 0, -style.thickness),
         f.at(u0, style.springing, -style.thickness), f.at(u1, style.springing, -style.thickness)},
        wall);
    relief(mesh, f, {u0, u1, 0, 0.55}, 0, 0.08, {Paint::StoneBase, SurfaceType::Wall});
    relief(mesh, f, {u0, u1, style.springing - 0.16, style.springing + 0.06}, 0, 0.1, trim);
    for (double v = 0.62; v + 0.4 < style.springing - 0.16; v += 0.44) {  // rusticated courses
        relief(mesh, f, {u0 + 0.03, u1 - 0.03, v, v + 0.4}, 0, 0.045, wall);
    }
}

void lantern(Mesh& mesh, const glm::dvec3& hook) {
    const Skin iron{Paint::Iron, SurfaceType::Unknown};
    const Skin glow{Paint::LampGlow, SurfaceType::Unknown};
    bar(mesh, hook, hook - glm::dvec3(0, 0, 0.7), 0.012, 0.012, 4, iron);
    lathe(mesh, hook - glm::dvec3(0, 0, 1.25), {{0.06, 0}, {0.13, 0.1}, {0.17, 0.4}}, 8, glow);
    lathe(mesh, hook - glm::dvec3(0, 0, 0.85), {{0.2, 0}, {0.06, 0.15}}, 8, iron);
}

/// The room behind the arches: ceiling with a rib over each pier, closed ends.
void passage(Mesh& mesh, const Facade& f, int bays, const ArcadeStyle& style) {
    const Skin vault{Paint::PlasterVault, SurfaceType::OuterCeiling};
    const double ceiling = style.height - 0.45;
    const double a = -style.depth, b = -style.thickness;
    mesh.polygon({f.at(0, ceiling, a), f.at(f.length, ceiling, a), f.at(f.length, ceiling, b),
                  f.at(0, ceiling, b)},
                 vault);
    const double bay = f.length / bays;
    const Facade back = f.moved(a);
    for (int i = 0; i <= bays; ++i) {
        const double left = std::max(0.0, i * bay - 0.25),
                     right = std::min(f.length, i * bay + 0.25);
        relief(mesh, back, {left, right, ceiling - 0.4, ceiling}, 0, style.depth - style.thickness,
               {Paint::TrimShade, SurfaceType::OuterCeiling});
    }
    // The ends stand a little inside, so that they share no plane with the house's sides.
    const double u0 = 0.3, u1 = f.length - 0.3;
    mesh.polygon({f.at(u0, 0, a), f.at(u0, ceiling, a), f.at(u0, ceiling, b), f.at(u0, 0, b)},
                 vault);
    mesh.polygon({f.at(u1, 0, b), f.at(u1, ceiling, b), f.at(u1, ceiling, a), f.at(u1, 0, a)},
                 vault);
}

}  // namespace

void arcade(Mesh& mesh, const Facade& f, int bays, const ArcadeStyle& style, Random& random) {
    const Skin wall{style.wall, SurfaceType::Wall};
    const double bay = f.length / bays;
    const Facade back = f.moved(-style.depth);
    constexpr double kShop = 3.5;
    for (int i = 0; i < bays; ++i) {
        const double u0 = i * bay, u1 = u0 + bay;
        const Arch arch{0.5 * (u0 + u1), 0.5 * (bay - style.pier), style.springing};
        spandrel(mesh, f, arch, u0, u1, style.height, 0, true, wall);
        spandrel(mesh, f, arch, u0, u1, style.height, -style.thickness, false, wall);
        soffit(mesh, f, arch, style.thickness, wall);
        archivolt(mesh, f, arch, {style.trim, SurfaceType::Wall});
        const double s0 = u0 + 0.45, s1 = u1 - 0.45;
        panel(mesh, back, {u0, s0, 0, kShop}, 0, {Paint::PlasterCream, SurfaceType::Wall});
        panel(mesh, back, {s1, u1, 0, kShop}, 0, {Paint::PlasterCream, SurfaceType::Wall});
        panel(mesh, back, {u0, u1, kShop, style.height - 0.45}, 0,
              {Paint::PlasterCream, SurfaceType::Wall});
        shopFront(mesh, back, s0, s1, kShop, random);
        if (i % 2 == 0) {
            lantern(mesh,
                    f.at(arch.center, style.height - 0.45, -0.5 * (style.depth + style.thickness)));
        }
    }
    for (int i = 0; i <= bays; ++i) {
        const double u = i * bay;
        pier(mesh, f, std::max(0.0, u - 0.5 * style.pier), std::min(f.length, u + 0.5 * style.pier),
             style);
    }
    passage(mesh, f, bays, style);
}

}  // namespace reflet::kit
