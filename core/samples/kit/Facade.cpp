// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Facade.h"

namespace reflet::kit {

Facade facadeOf(const Plot& p, Side side, double z) {
    switch (side) {
        case Side::South:
            return {{p.x0, p.y0, z}, {1, 0}, p.width()};
        case Side::East:
            return {{p.x1, p.y0, z}, {0, 1}, p.depth()};
        case Side::North:
            return {{p.x1, p.y1, z}, {-1, 0}, p.width()};
        case Side::West:
            break;
    }
    return {{p.x0, p.y1, z}, {0, -1}, p.depth()};
}

void panel(Mesh& mesh, const Facade& f, const Field& r, double w, Skin skin) {
    mesh.polygon(
        {f.at(r.u0, r.v0, w), f.at(r.u1, r.v0, w), f.at(r.u1, r.v1, w), f.at(r.u0, r.v1, w)}, skin);
}

void ledge(Mesh& mesh, const Facade& f, const Field& r, double w0, double w1, Skin skin) {
    panel(mesh, f, r, w1, skin);
    mesh.polygon(
        {f.at(r.u0, r.v1, w1), f.at(r.u1, r.v1, w1), f.at(r.u1, r.v1, w0), f.at(r.u0, r.v1, w0)},
        skin);
    mesh.polygon(
        {f.at(r.u0, r.v0, w0), f.at(r.u1, r.v0, w0), f.at(r.u1, r.v0, w1), f.at(r.u0, r.v0, w1)},
        skin);
}

void relief(Mesh& mesh, const Facade& f, const Field& r, double w0, double w1, Skin skin) {
    ledge(mesh, f, r, w0, w1, skin);
    mesh.polygon(
        {f.at(r.u0, r.v0, w0), f.at(r.u0, r.v0, w1), f.at(r.u0, r.v1, w1), f.at(r.u0, r.v1, w0)},
        skin);
    mesh.polygon(
        {f.at(r.u1, r.v0, w1), f.at(r.u1, r.v0, w0), f.at(r.u1, r.v1, w0), f.at(r.u1, r.v1, w1)},
        skin);
}

void reveal(Mesh& mesh, const Facade& f, const Field& r, double d, Skin skin) {
    mesh.polygon(
        {f.at(r.u0, r.v0, -d), f.at(r.u0, r.v1, -d), f.at(r.u0, r.v1, 0), f.at(r.u0, r.v0, 0)},
        skin);
    mesh.polygon(
        {f.at(r.u1, r.v0, 0), f.at(r.u1, r.v1, 0), f.at(r.u1, r.v1, -d), f.at(r.u1, r.v0, -d)},
        skin);
    mesh.polygon(
        {f.at(r.u0, r.v1, -d), f.at(r.u1, r.v1, -d), f.at(r.u1, r.v1, 0), f.at(r.u0, r.v1, 0)},
        skin);
    mesh.polygon(
        {f.at(r.u0, r.v0, 0), f.at(r.u1, r.v0, 0), f.at(r.u1, r.v0, -d), f.at(r.u0, r.v0, -d)},
        skin);
}

void pierced(Mesh& mesh, const Facade& f, double v0, double v1, std::span<const Field> openings,
             Skin skin) {
    if (openings.empty()) {
        panel(mesh, f, {0, f.length, v0, v1}, 0, skin);
        return;
    }
    const double low = openings.front().v0;
    const double high = openings.front().v1;
    panel(mesh, f, {0, f.length, v0, low}, 0, skin);
    panel(mesh, f, {0, f.length, high, v1}, 0, skin);
    double u = 0.0;
    for (const Field& opening : openings) {
        panel(mesh, f, {u, opening.u0, low, high}, 0, skin);
        u = opening.u1;
    }
    panel(mesh, f, {u, f.length, low, high}, 0, skin);
}

}  // namespace reflet::kit
