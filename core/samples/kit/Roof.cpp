// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Roof.h"

#include "core/samples/kit/Window.h"

#include <algorithm>
#include <cmath>

namespace reflet::kit {

namespace {

Paint tile(Random& random) {
    static constexpr std::array kTiles{Paint::RoofA, Paint::RoofA, Paint::RoofB,
                                       Paint::RoofB, Paint::RoofC, Paint::RoofD};
    return random.pick(kTiles);
}

/// The roof in its own axes: s along the ridge, t across; turned back into the plot's.
struct RoofFrame {
    double s0, s1, t0, t1;  ///< eaves
    bool alongX;

    [[nodiscard]] glm::dvec3 at(double s, double t, double z) const {
        return alongX ? glm::dvec3(s, t, z) : glm::dvec3(-t, s, z);
    }
    [[nodiscard]] double middle() const { return 0.5 * (t0 + t1); }
    [[nodiscard]] double run() const { return 0.5 * (t1 - t0); }
};

RoofFrame frameOf(const Plot& plot, const RoofStyle& style) {
    const double o = style.overhang;
    const double start = style.hipStart ? o : 0.15;
    const double end = style.hipEnd ? o : 0.15;
    if (style.alongX) {
        return {plot.x0 - start, plot.x1 + end, plot.y0 - o, plot.y1 + o, true};
    }
    return {plot.y0 - start, plot.y1 + end, -plot.x1 - o, -plot.x0 + o, false};
}

void fascia(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, double height) {
    const glm::dvec3 up(0, 0, height);
    mesh.polygon({a - up, b - up, b, a}, {Paint::Trim, SurfaceType::Roof});
}

void ridgeTiles(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b) {
    if (glm::length(b - a) > 0.5) {
        bar(mesh, a, b, 0.12, 0.12, 6, {Paint::RoofRidge, SurfaceType::Roof});
    }
}

}  // namespace

void tiledSlope(Mesh& mesh, const glm::dvec3& a0, const glm::dvec3& a1, const glm::dvec3& b1,
                const glm::dvec3& b0, double course, double patch, Random& random) {
    const double length = glm::length(0.5 * (b0 + b1) - 0.5 * (a0 + a1));
    const int bands = std::max(1, int(std::lround(length / course)));
    for (int k = 0; k < bands; ++k) {
        const double t0 = double(k) / bands, t1 = double(k + 1) / bands;
        const glm::dvec3 l0 = glm::mix(a0, b0, t0), l1 = glm::mix(a0, b0, t1);
        const glm::dvec3 r0 = glm::mix(a1, b1, t0), r1 = glm::mix(a1, b1, t1);
        const int parts =
            std::max(1, int(glm::length(r0 - l0) / (patch * random.between(0.55, 1.5))));
        for (int i = 0; i < parts; ++i) {
            const double s0 = double(i) / parts, s1 = double(i + 1) / parts;
            mesh.polygon({glm::mix(l0, r0, s0), glm::mix(l0, r0, s1), glm::mix(l1, r1, s1),
                          glm::mix(l1, r1, s0)},
                         {tile(random), SurfaceType::Roof});
        }
    }
}

double roofHeightAt(const Plot& plot, const RoofStyle& style, double x, double y) {
    const RoofFrame f = frameOf(plot, style);
    const double s = f.alongX ? x : y;
    const double t = f.alongX ? y : -x;
    double inset = std::min(t - f.t0, f.t1 - t);
    if (style.hipStart) {
        inset = std::min(inset, s - f.s0);
    }
    if (style.hipEnd) {
        inset = std::min(inset, f.s1 - s);
    }
    return style.pitch * inset;
}

void tiledRoof(Mesh& mesh, const Plot& plot, double z, const RoofStyle& style, Random& random) {
    const RoofFrame f = frameOf(plot, style);
    const double run =
        std::min({f.run(), style.hipStart || style.hipEnd
                               ? 0.5 * (f.s1 - f.s0) * (style.hipStart && style.hipEnd ? 1 : 2)
                               : f.run()});
    const double rise = style.pitch * f.run();
    const double r0 = style.hipStart ? f.s0 + run : f.s0;
    const double r1 = style.hipEnd ? f.s1 - run : f.s1;
    const glm::dvec3 sw = f.at(f.s0, f.t0, z), se = f.at(f.s1, f.t0, z);
    const glm::dvec3 nw = f.at(f.s0, f.t1, z), ne = f.at(f.s1, f.t1, z);
    const glm::dvec3 ridge0 = f.at(r0, f.middle(), z + rise),
                     ridge1 = f.at(r1, f.middle(), z + rise);
    tiledSlope(mesh, sw, se, ridge1, ridge0, style.course, style.patch, random);
    tiledSlope(mesh, ne, nw, ridge0, ridge1, style.course, style.patch, random);
    const auto end = [&](bool hip, const glm::dvec3& a, const glm::dvec3& b,
                         const glm::dvec3& top) {
        if (hip) {
            tiledSlope(mesh, a, b, top, top, style.course, style.patch, random);
            fascia(mesh, a, b, 0.16);
            if (style.ridgeTiles) {
                ridgeTiles(mesh, a, top);
                ridgeTiles(mesh, b, top);
            }
        } else {
            mesh.polygon({a, b, top}, {style.gable, SurfaceType::Wall});
        }
    };
    end(style.hipStart, nw, sw, ridge0);
    end(style.hipEnd, se, ne, ridge1);
    if (style.ridgeTiles) {
        ridgeTiles(mesh, ridge0, ridge1);
    }
    fascia(mesh, sw, se, 0.16);
    fascia(mesh, ne, nw, 0.16);
    const glm::dvec3 down(0, 0, 0.16);
    mesh.polygon({sw - down, nw - down, ne - down, se - down},
                 {Paint::Trim, SurfaceType::OuterCeiling});
}

void chimney(Mesh& mesh, const glm::dvec2& c, double z0, double z1, Paint wall) {
    const Skin skin{wall, SurfaceType::Wall};
    block(mesh, {c.x - 0.35, c.y - 0.55, c.x + 0.35, c.y + 0.55}, z0, z1, skin, skin);
    block(mesh, {c.x - 0.42, c.y - 0.62, c.x + 0.42, c.y + 0.62}, z1, z1 + 0.12,
          {Paint::StoneDark, SurfaceType::Wall}, {Paint::StoneDark, SurfaceType::Roof});
    for (const double dy : {-0.3, 0.3}) {
        lathe(mesh, {c.x, c.y + dy, z1 + 0.12}, {{0.13, 0}, {0.1, 0.45}}, 5,
              {Paint::RoofB, SurfaceType::Roof});
    }
}

void dormer(Mesh& mesh, const Facade& f, double center, double back, double v, double pitch,
            Paint wall, Random& random) {
    const Skin skin{wall, SurfaceType::Wall};
    constexpr double kHalf = 0.8;
    constexpr double kHeight = 1.55;
    const Facade front = f.moved(-back);
    const Field opening{center - 0.45, center + 0.45, v + 0.1, v + 1.35};
    panel(mesh, front, {center - kHalf, opening.u0, v, v + kHeight}, 0, skin);
    panel(mesh, front, {opening.u1, center + kHalf, v, v + kHeight}, 0, skin);
    panel(mesh, front, {opening.u0, opening.u1, v, opening.v0}, 0, skin);
    panel(mesh, front, {opening.u0, opening.u1, opening.v1, v + kHeight}, 0, skin);
    reveal(mesh, front, opening, 0.15, skin);
    glazing(mesh, front, opening, -0.12, 2, 2, Paint::FrameWhite, random);
    const double rise = 0.55, top = v + kHeight;
    mesh.polygon({front.at(center - kHalf, top, 0), front.at(center + kHalf, top, 0),
                  front.at(center, top + rise, 0)},
                 skin);
    const double deepEave = kHeight / pitch, deepRidge = (kHeight + rise) / pitch;
    for (const double side : {-1.0, 1.0}) {  // cheek and roof half
        const double u = center + side * kHalf, eave = center + side * (kHalf + 0.15);
        const double drop = rise * 0.15 / kHalf;
        mesh.polygon({front.at(u, v, 0), front.at(u, top, 0), front.at(u, top, -deepEave)}, skin);
        tiledSlope(mesh, front.at(eave, top - drop, 0.2), front.at(eave, top - drop, -deepEave),
                   front.at(center, top + rise, -deepRidge), front.at(center, top + rise, 0.2), 0.5,
                   3.0, random);
    }
}

}  // namespace reflet::kit
