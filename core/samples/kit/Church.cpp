// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Church.h"

#include "core/samples/kit/Ornament.h"
#include "core/samples/kit/Roof.h"

#include <algorithm>
#include <cmath>

namespace reflet::kit {

namespace {

constexpr Skin kWall{Paint::PlasterYellow, SurfaceType::Wall};
constexpr Skin kStone{Paint::StonePale, SurfaceType::Wall};

void pilaster(Mesh& mesh, const Facade& f, double u, double width, double v0, double v1) {
    relief(mesh, f, {u - 0.5 * width - 0.12, u + 0.5 * width + 0.12, v0, v0 + 0.7}, 0, 0.42,
           kStone);
    relief(mesh, f, {u - 0.5 * width, u + 0.5 * width, v0 + 0.7, v1 - 0.6}, 0, 0.3, kStone);
    relief(mesh, f, {u - 0.5 * width - 0.1, u + 0.5 * width + 0.1, v1 - 0.6, v1 - 0.35}, 0, 0.38,
           kStone);
    relief(mesh, f, {u - 0.5 * width - 0.2, u + 0.5 * width + 0.2, v1 - 0.35, v1}, 0, 0.48, kStone);
}

void entablature(Mesh& mesh, const Facade& f, double u0, double u1, double v) {
    relief(mesh, f, {u0, u1, v, v + 0.5}, 0, 0.4, kStone);
    relief(mesh, f, {u0, u1, v + 0.5, v + 1.0}, 0, 0.34, {Paint::TrimShade, SurfaceType::Wall});
    relief(mesh, f, {u0 - 0.2, u1 + 0.2, v + 1.0, v + 1.35}, 0, 0.85, kStone);
}

/// Arch-headed outline standing on v0, counter-clockwise.
std::vector<glm::dvec3> archOutline(const Facade& f, double center, double width, double v0,
                                    double springing, double w) {
    constexpr int kSegments = 16;
    const double r = 0.5 * width;
    std::vector<glm::dvec3> ring{f.at(center - r, v0, w), f.at(center + r, v0, w)};
    for (int i = 0; i <= kSegments; ++i) {
        const double angle = kPi * i / kSegments;
        ring.push_back(f.at(center + r * std::cos(angle), springing + r * std::sin(angle), w));
    }
    return ring;
}

void portal(Mesh& mesh, const Facade& f, double center, double width, double height) {
    const double r = 0.5 * width;
    mesh.polygon(archOutline(f, center, width + 0.9, 0, height - r, 0.1), kStone);
    mesh.polygon(archOutline(f, center, width, 0, height - r, 0.16),
                 {Paint::DoorWood, SurfaceType::Door});
    const Skin lines{Paint::FrameWood, SurfaceType::Door};
    relief(mesh, f, {center - 0.05, center + 0.05, 0, height - r}, 0.16, 0.22, lines);
    for (double v = 0.4; v + 0.8 < height - r; v += 1.0) {
        relief(mesh, f, {center - r + 0.2, center - 0.2, v, v + 0.75}, 0.16, 0.2, lines);
        relief(mesh, f, {center + 0.2, center + r - 0.2, v, v + 0.75}, 0.16, 0.2, lines);
    }
}

void roundWindow(Mesh& mesh, const Facade& f, double center, double v, double radius) {
    const auto ring = [&](double r, double w, Skin skin) {
        std::vector<glm::dvec3> points;
        for (int i = 0; i < 24; ++i) {
            const double a = 2.0 * kPi * i / 24;
            points.push_back(f.at(center + r * std::cos(a), v + r * std::sin(a), w));
        }
        mesh.polygon(points, skin);
    };
    ring(radius + 0.45, 0.12, kStone);
    ring(radius + 0.15, 0.15, {Paint::TrimShade, SurfaceType::Wall});
    ring(radius, 0.18, {Paint::GlassDark, SurfaceType::Window});
    for (int i = 0; i < 6; ++i) {  // tracery
        const double a = kPi * i / 6;
        const glm::dvec2 d(std::cos(a), std::sin(a));
        const glm::dvec2 n(-0.05 * d.y, 0.05 * d.x);
        const auto p = [&](const glm::dvec2& q) {
            return f.at(center + q.x, v + q.y, 0.21 + 0.012 * i);
        };
        mesh.polygon({p(-radius * d - n), p(radius * d - n), p(radius * d + n), p(-radius * d + n)},
                     kStone);
    }
}

void volute(Mesh& mesh, const Facade& f, double inner, double outer, double v0, double v1) {
    std::vector<glm::dvec3> ring;
    constexpr int kSteps = 10;
    for (int i = 0; i <= kSteps; ++i) {  // a quarter ellipse hollowed towards the wing
        const double a = 0.5 * kPi * i / kSteps;
        ring.push_back(
            f.at(outer + (inner - outer) * std::sin(a), v1 - (v1 - v0) * std::cos(a), 0.0));
    }
    ring.push_back(f.at(inner, v0, 0.0));
    if (outer < inner) {
        ring = {ring.rbegin(), ring.rend()};
    }
    mesh.polygon(ring, kWall);
    for (int i = 0; i < kSteps; ++i) {  // its coping
        const double a = 0.5 * kPi * i / kSteps, b = 0.5 * kPi * (i + 1) / kSteps;
        const auto p = [&](double t, double w) {
            return f.at(outer + (inner - outer) * std::sin(t), v1 - (v1 - v0) * std::cos(t), w);
        };
        mesh.polygon({p(a, -0.7), p(b, -0.7), p(b, 0.25), p(a, 0.25)}, kStone);
    }
}

void nave(Mesh& mesh, const Facade& f, double depth, Random& random) {
    const glm::dvec3 a = f.at(3.0, 0, -1.2), b = f.at(f.length - 3.0, 0, -1.2 - depth);
    const Plot plot{std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
    const double z = f.origin.z;
    block(mesh, plot, z, z + 15.0, kWall, {Paint::RoofB, SurfaceType::Roof});
    RoofStyle roof;
    roof.alongX = std::abs(f.right.y) > 0.5;
    roof.hipStart = roof.hipEnd = false;
    roof.gable = Paint::PlasterYellow;
    tiledRoof(mesh, plot, z + 15.2, roof, random);
}

void pedimentOver(Mesh& mesh, const Facade& f, double u0, double u1, double v, double rise) {
    const double middle = 0.5 * (u0 + u1);
    mesh.polygon({f.at(u0, v, 0.3), f.at(u1, v, 0.3), f.at(middle, v + rise, 0.3)}, kWall);
    for (const double end : {u0, u1}) {
        const glm::dvec3 up(0, 0, 0.35);
        const glm::dvec3 a = f.at(end, v, 0.85), b = f.at(middle, v + rise, 0.85);
        const glm::dvec3 c = f.at(middle, v + rise, -0.9), d = f.at(end, v, -0.9);
        mesh.polygon({a, b, b + up, a + up}, kStone);
        mesh.polygon({a + up, b + up, c + up, d + up}, kStone);
        mesh.polygon({a, d, c, b}, kStone);
    }
}

void clockFace(Mesh& mesh, const Facade& f, double v, double radius) {
    const double center = 0.5 * f.length;
    const auto dial = [&](double r, double w, Skin skin) {
        std::vector<glm::dvec3> points;
        for (int i = 0; i < 28; ++i) {
            const double a = 2.0 * kPi * i / 28;
            points.push_back(f.at(center + r * std::cos(a), v + r * std::sin(a), w));
        }
        mesh.polygon(points, skin);
    };
    const Skin hand{Paint::Iron, SurfaceType::Wall};
    dial(radius + 0.28, 0.1, kStone);
    dial(radius, 0.14, {Paint::ClockFace, SurfaceType::Wall});
    const auto ray = [&](double hours, double from, double to, double half, double w) {
        const double a = 0.5 * kPi - hours / 12.0 * 2.0 * kPi;
        const glm::dvec2 d(std::cos(a), std::sin(a)), n(-half * d.y, half * d.x);
        const auto p = [&](const glm::dvec2& q) { return f.at(center + q.x, v + q.y, w); };
        mesh.polygon({p(from * d - n), p(from * d + n), p(to * d + n), p(to * d - n)}, hand);
    };
    for (int hour = 0; hour < 12; ++hour) {
        ray(hour, 0.78 * radius, 0.94 * radius, hour % 3 == 0 ? 0.08 : 0.04, 0.16);
    }
    ray(10.0, -0.12 * radius, 0.52 * radius, 0.07, 0.18);  // ten o'clock, as in the pictures
    ray(0.0, -0.12 * radius, 0.8 * radius, 0.05, 0.2);
}

void belfryOpening(Mesh& mesh, const Facade& f, double v) {
    const double c = 0.5 * f.length;
    mesh.polygon(archOutline(f, c, 2.9, v, v + 3.1, 0.06), kStone);
    mesh.polygon(archOutline(f, c, 2.2, v + 0.25, v + 3.1, 0.1),
                 {Paint::GlassDark, SurfaceType::Wall});
    for (int i = 0; i < 7; ++i) {  // sound louvres
        const double y = v + 0.5 + 0.42 * i;
        mesh.polygon({f.at(c - 1.05, y, 0.28), f.at(c + 1.05, y, 0.28),
                      f.at(c + 1.05, y + 0.26, 0.12), f.at(c - 1.05, y + 0.26, 0.12)},
                     {Paint::FrameWood, SurfaceType::Wall});
    }
}

}  // namespace

void church(Mesh& mesh, const Facade& f, double naveDepth, Random& random) {
    const double middle = 0.5 * f.length, wing = 0.5 * f.length - 0.2, core = 5.9;
    constexpr double kFirst = 11.0;
    constexpr double kSecond = 19.5;
    const glm::dvec2 back = -1.2 * f.out();
    const auto wallPiece = [&](double u0, double u1, double v1) {
        const glm::dvec3 a = f.at(u0, 0, 0), b = f.at(u1, 0, 0) + glm::dvec3(back, 0);
        block(mesh,
              {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)},
              f.origin.z, f.origin.z + v1, kWall, kStone);
    };
    wallPiece(middle - wing, middle + wing, kFirst + 1.2);
    wallPiece(middle - core, middle + core, kSecond + 1.2);
    relief(mesh, f, {middle - wing, middle + wing, 0, 1.0}, 0, 0.2,
           {Paint::StoneBase, SurfaceType::Wall});
    for (const double u : {-9.6, -6.9, -4.6, -2.7, 2.7, 4.6, 6.9, 9.6}) {
        pilaster(mesh, f, middle + u, 0.9, 1.0, kFirst);
    }
    for (const double u : {-4.9, -2.7, 2.7, 4.9}) {
        pilaster(mesh, f, middle + u, 0.8, kFirst + 1.35, kSecond);
    }
    entablature(mesh, f, middle - wing, middle + wing, kFirst);
    entablature(mesh, f, middle - core, middle + core, kSecond);
    pedimentOver(mesh, f, middle - core - 0.2, middle + core + 0.2, kSecond + 1.35, 2.6);
    volute(mesh, f, middle - core, middle - wing + 0.8, kFirst + 1.35, kSecond - 1.5);
    volute(mesh, f, middle + core, middle + wing - 0.8, kFirst + 1.35, kSecond - 1.5);
    portal(mesh, f, middle, 3.2, 6.6);
    portal(mesh, f, middle - 8.2, 1.5, 4.2);
    portal(mesh, f, middle + 8.2, 1.5, 4.2);
    roundWindow(mesh, f, middle, kFirst + 4.8, 1.5);
    for (int step = 0; step < 3; ++step) {
        const double out = 1.6 - 0.45 * step;
        relief(
            mesh, f,
            {middle - 4.5 + 0.4 * step, middle + 4.5 - 0.4 * step, 0.16 * step, 0.16 * (step + 1)},
            0, out, {Paint::Granite, SurfaceType::Wall});
    }
    nave(mesh, f, naveDepth, random);
}

void clockTower(Mesh& mesh, const Plot& plot, double z, Random& random) {
    constexpr double kShaft = 25.0;
    constexpr double kBelfry = 34.0;
    block(mesh, plot, z, z + kBelfry, {Paint::PlasterOchre, SurfaceType::Wall}, kStone);
    block(mesh, plot.grown(0.35), z, z + 2.2, {Paint::StoneBase, SurfaceType::Wall}, kStone);
    for (std::size_t s = 0; s < 4; ++s) {
        const Facade f = facadeOf(plot, Side(s), z);
        quoins(mesh, f, 2.3, kShaft - 0.4, Paint::StonePale);
        for (const double v : {9.0, 17.5}) {
            stringCourse(mesh, f, v, 0.25, 0.14, Paint::StonePale);
        }
        for (const double v : {5.0, 12.0}) {  // slit windows
            relief(mesh, f, {0.5 * f.length - 0.55, 0.5 * f.length + 0.55, v - 0.25, v + 2.35}, 0,
                   0.08, kStone);
            panel(mesh, f, {0.5 * f.length - 0.3, 0.5 * f.length + 0.3, v, v + 2.1}, 0.11,
                  {Paint::GlassDark, SurfaceType::Window});
        }
        clockFace(mesh, f, 21.3, 1.75);
        relief(mesh, f, {-0.3, f.length + 0.3, kShaft - 0.2, kShaft + 0.35}, 0, 0.45, kStone);
        belfryOpening(mesh, f, kShaft + 1.6);
        pilaster(mesh, f, 0.75, 0.9, kShaft + 0.35, kBelfry - 0.2);
        pilaster(mesh, f, f.length - 0.75, 0.9, kShaft + 0.35, kBelfry - 0.2);
        relief(mesh, f, {-0.5, f.length + 0.5, kBelfry - 0.2, kBelfry + 0.4}, 0, 0.7, kStone);
    }
    const glm::dvec2 c = plot.center();
    const double r = 0.5 * plot.width();
    const glm::dvec3 top(c, z + kBelfry + 0.4);
    lathe(mesh, top, {{r * 0.98, 0}, {r * 0.98, 1.7}}, 8, kWall);
    lathe(mesh, top, {{r * 1.08, 1.7}, {r * 1.08, 2.1}, {r * 0.95, 2.1}}, 8, kStone);
    std::vector<glm::dvec2> dome;
    for (int i = 0; i <= 9; ++i) {
        const double a = 0.5 * kPi * i / 9.6;
        dome.emplace_back(r * 0.97 * std::cos(a), 2.1 + 4.6 * std::sin(a));
    }
    for (std::size_t i = 0; i + 1 < dome.size(); ++i) {  // courses of glazed tiles
        const Paint paint = i % 2 == 0           ? Paint::DomeTile
                            : random.chance(0.4) ? Paint::DomeTileB
                                                 : Paint::DomeTile;
        lathe(mesh, top, {dome[i], dome[i + 1]}, 16, {paint, SurfaceType::Roof});
    }
    const double lantern = dome.back().y;
    lathe(
        mesh, top,
        {{0.75, lantern - 0.2}, {0.75, lantern + 1.7}, {1.0, lantern + 1.7}, {0.0, lantern + 2.9}},
        8, kStone);
    bar(mesh, top + glm::dvec3(0, 0, lantern + 2.8), top + glm::dvec3(0, 0, lantern + 5.0), 0.05,
        0.03, 5, {Paint::Gold, SurfaceType::Roof});
    lathe(mesh, top + glm::dvec3(0, 0, lantern + 2.9), {{0.0, 0}, {0.24, 0.2}, {0.0, 0.44}}, 8,
          {Paint::Gold, SurfaceType::Roof});
}

}  // namespace reflet::kit
