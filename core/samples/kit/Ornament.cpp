// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Ornament.h"

#include <algorithm>
#include <cmath>

namespace reflet::kit {

void stringCourse(Mesh& mesh, const Facade& f, double v, double height, double out, Paint paint) {
    const Skin skin{paint, SurfaceType::Wall};
    ledge(mesh, f, {0, f.length, v, v + height}, 0, out, skin);
    ledge(mesh, f, {0, f.length, v + height, v + height + 0.06}, 0, out + 0.05, skin);
}

void cornice(Mesh& mesh, const Facade& f, double v, double spacing, Paint paint) {
    const Skin skin{paint, SurfaceType::Wall};
    ledge(mesh, f, {0, f.length, v, v + 0.3}, 0, 0.1, skin);
    ledge(mesh, f, {0, f.length, v + 0.5, v + 0.68}, 0, 0.42, skin);
    ledge(mesh, f, {0, f.length, v + 0.68, v + kCorniceHeight}, 0, 0.52, skin);
    panel(mesh, f, {0, f.length, v + 0.3, v + 0.5}, 0.08, {Paint::TrimShade, SurfaceType::Wall});
    const int count = std::max(2, int(std::lround(f.length / spacing)));
    const double step = f.length / count;
    for (int i = 0; i < count; ++i) {
        const double u = (i + 0.5) * step;
        relief(mesh, f, {u - 0.11, u + 0.11, v + 0.3, v + 0.5}, 0.08, 0.36, skin);
    }
}

void quoins(Mesh& mesh, const Facade& f, double v0, double v1, Paint paint) {
    const Skin skin{paint, SurfaceType::Wall};
    const int count = std::max(1, int((v1 - v0) / 0.42));
    const double step = (v1 - v0) / count;
    for (int i = 0; i < count; ++i) {
        const double wide = i % 2 == 0 ? 0.62 : 0.4;
        const double v = v0 + i * step;
        ledge(mesh, f, {0, wide, v, v + step - 0.03}, 0, 0.04, skin);
        ledge(mesh, f, {f.length - wide, f.length, v, v + step - 0.03}, 0, 0.04, skin);
    }
}

void railing(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double height,
             double spacing, Paint paint) {
    const Skin skin{paint, SurfaceType::Unknown};
    const glm::dvec3 up(0, 0, height);
    const double length = glm::length(to - from);
    const glm::dvec3 half = 0.014 / length * (to - from);  // bars are flat irons
    const int count = std::max(1, int(std::lround(length / spacing)));
    bar(mesh, from + up, to + up, 0.025, 0.025, 4, skin);
    bar(mesh, from + 0.1 * up, to + 0.1 * up, 0.015, 0.015, 3, skin);
    for (int i = 0; i <= count; ++i) {
        const glm::dvec3 foot = from + (to - from) * (double(i) / count);
        mesh.polygon({foot - half, foot + half, foot + half + up, foot - half + up}, skin);
    }
}

void balcony(Mesh& mesh, const Facade& f, double u0, double u1, double v, double depth,
             Paint stone) {
    const Skin skin{stone, SurfaceType::Wall};
    relief(mesh, f, {u0, u1, v - 0.16, v}, 0, depth, skin);
    for (const double u : {u0 + 0.2, u1 - 0.4}) {  // consoles that lean out
        const glm::dvec3 a = f.at(u, v - 0.7, 0), b = f.at(u, v - 0.16, depth - 0.12),
                         c = f.at(u, v - 0.16, 0);
        const glm::dvec3 wide(0.2 * f.right, 0.0);
        mesh.polygon({a, b, c}, skin);
        mesh.polygon({a + wide, c + wide, b + wide}, skin);
        mesh.polygon({a, a + wide, b + wide, b}, skin);
    }
    const double out = depth - 0.06;
    railing(mesh, f.at(u0 + 0.05, v, out), f.at(u1 - 0.05, v, out), 1.0, 0.13, Paint::Iron);
    railing(mesh, f.at(u0 + 0.05, v, 0.05), f.at(u0 + 0.05, v, out), 1.0, 0.13, Paint::Iron);
    railing(mesh, f.at(u1 - 0.05, v, 0.05), f.at(u1 - 0.05, v, out), 1.0, 0.13, Paint::Iron);
}

}  // namespace reflet::kit
