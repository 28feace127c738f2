// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Window.h"

namespace reflet::kit {

namespace {

constexpr double kRevealDepth = 0.24;

/// Seen from the street a pane shows the dark room, the sky, or a curtain.
Paint paneOf(Random& random, bool upper, Paint mood) {
    if (mood == Paint::GlassCurtain && !upper) {
        return random.chance(0.8) ? Paint::GlassCurtain : Paint::GlassDark;
    }
    if (mood == Paint::GlassLit) {
        return Paint::GlassLit;
    }
    return random.chance(upper ? 0.55 : 0.2) ? Paint::GlassSky : Paint::GlassDark;
}

void shutterLeaf(Mesh& mesh, const Facade& f, const Field& leaf, double w,
                 const WindowStyle& style) {
    const Skin light{style.shutter, SurfaceType::Wall};
    const Skin dark{style.shutterDark, SurfaceType::Wall};
    constexpr double kThick = 0.05;
    if (style.detail == Detail::Low) {
        panel(mesh, f, leaf, w + kThick, light);
        return;
    }
    panel(mesh, f, leaf, w + kThick, dark);
    for (const double u : {leaf.u0, leaf.u1}) {
        mesh.polygon({f.at(u, leaf.v0, w), f.at(u, leaf.v0, w + kThick),
                      f.at(u, leaf.v1, w + kThick), f.at(u, leaf.v1, w)},
                     dark);
    }
    const int slats = style.detail == Detail::High ? 9 : 3;
    const double step = (leaf.v1 - leaf.v0) / (2.0 * slats + 1.0);
    for (int i = 0; i <= slats; ++i) {  // the louvres stand out of the leaf
        const double v = leaf.v0 + 2.0 * i * step;
        panel(mesh, f, {leaf.u0, leaf.u1, v, v + step}, w + kThick + 0.012, light);
    }
}

void shutterPair(Mesh& mesh, const Facade& f, const Field& o, const WindowStyle& style,
                 Random& random) {
    const double leaf = 0.5 * (o.u1 - o.u0);
    if (random.chance(0.13)) {  // closed against the morning sun
        shutterLeaf(mesh, f, {o.u0, o.u0 + leaf - 0.01, o.v0, o.v1}, -0.07, style);
        shutterLeaf(mesh, f, {o.u1 - leaf + 0.01, o.u1, o.v0, o.v1}, -0.07, style);
        return;
    }
    const double gap = style.surround ? 0.15 : 0.03;
    shutterLeaf(mesh, f, {o.u0 - gap - leaf, o.u0 - gap, o.v0, o.v1}, 0.02, style);
    shutterLeaf(mesh, f, {o.u1 + gap, o.u1 + gap + leaf, o.v0, o.v1}, 0.02, style);
}

void surround(Mesh& mesh, const Facade& f, const Field& o, Paint trim) {
    const Skin skin{trim, SurfaceType::Wall};
    constexpr double kWide = 0.13;
    constexpr double kOut = 0.04;
    const auto jamb = [&](double u0, double u1, double outer) {
        panel(mesh, f, {u0, u1, o.v0, o.v1}, kOut, skin);
        mesh.polygon({f.at(outer, o.v0, 0), f.at(outer, o.v0, kOut), f.at(outer, o.v1, kOut),
                      f.at(outer, o.v1, 0)},
                     skin);
    };
    jamb(o.u0 - kWide, o.u0, o.u0 - kWide);
    jamb(o.u1, o.u1 + kWide, o.u1 + kWide);
    ledge(mesh, f, {o.u0 - kWide, o.u1 + kWide, o.v1, o.v1 + 0.16}, 0, 0.05, skin);
}

void pediment(Mesh& mesh, const Facade& f, double u0, double u1, double v, Skin skin) {
    const double middle = 0.5 * (u0 + u1);
    const double rise = 0.2 * (u1 - u0);
    constexpr double kOut = 0.22;
    mesh.polygon({f.at(u0, v, 0.1), f.at(u1, v, 0.1), f.at(middle, v + rise, 0.1)}, skin);
    for (const double end : {u0, u1}) {  // two raking mouldings
        const glm::dvec3 low = f.at(end, v, kOut), lowBack = f.at(end, v, 0.0);
        const glm::dvec3 top = f.at(middle, v + rise, kOut), topBack = f.at(middle, v + rise, 0.0);
        const glm::dvec3 up(0, 0, 0.11);
        mesh.polygon({low, top, top + up, low + up}, skin);
        mesh.polygon({low + up, top + up, topBack + up, lowBack + up}, skin);
        mesh.polygon({low, lowBack, topBack, top}, skin);
        mesh.polygon({low, low + up, lowBack + up, lowBack}, skin);
    }
}

void crown(Mesh& mesh, const Facade& f, const Field& o, const WindowStyle& style) {
    if (style.crown == Crown::None) {
        return;
    }
    const Skin skin{style.trim, SurfaceType::Wall};
    const double v = o.v1 + 0.3;
    relief(mesh, f, {o.u0 - 0.25, o.u1 + 0.25, v, v + 0.1}, 0, 0.22, skin);
    for (const double u : {o.u0 - 0.2, o.u1 + 0.06}) {  // consoles
        relief(mesh, f, {u, u + 0.14, v - 0.3, v}, 0, 0.14, skin);
    }
    if (style.crown == Crown::Pediment) {
        pediment(mesh, f, o.u0 - 0.25, o.u1 + 0.25, v + 0.1, skin);
    }
}

}  // namespace

Field windowOpening(const WindowStyle& style, double center, double sill) {
    return {center - 0.5 * style.width, center + 0.5 * style.width, sill, sill + style.height};
}

void glazing(Mesh& mesh, const Facade& f, const Field& o, double w, int columns, int rows,
             Paint frame, Random& random) {
    const Skin bars{frame, SurfaceType::Window};
    constexpr double kBar = 0.06;
    const double roll = random.unit();
    const Paint mood = roll < 0.3    ? Paint::GlassCurtain
                       : roll < 0.36 ? Paint::GlassLit
                                     : Paint::GlassDark;
    const double paneWidth = (o.u1 - o.u0 - kBar * (columns + 1)) / columns;
    const double paneHeight = (o.v1 - o.v0 - kBar * (rows + 1)) / rows;
    panel(mesh, f, o, w, bars);
    for (int row = 0; row < rows; ++row) {
        const double v = o.v0 + kBar + row * (paneHeight + kBar);
        for (int column = 0; column < columns; ++column) {
            const double u = o.u0 + kBar + column * (paneWidth + kBar);
            panel(mesh, f, {u, u + paneWidth, v, v + paneHeight}, w + 0.01,
                  {paneOf(random, row + 1 == rows, mood), SurfaceType::Window});
        }
    }
}

void window(Mesh& mesh, const Facade& f, double center, double sill, const WindowStyle& style,
            Random& random) {
    const Field o = windowOpening(style, center, sill);
    reveal(mesh, f, o, kRevealDepth, {style.surround ? style.trim : style.wall, SurfaceType::Wall});
    const bool far = style.detail == Detail::Low;
    glazing(mesh, f, o, -kRevealDepth + 0.04, far ? 1 : 2, far ? 1 : style.paneRows,
            Paint::FrameWhite, random);
    relief(mesh, f, {o.u0 - 0.18, o.u1 + 0.18, o.v0 - 0.1, o.v0}, 0, 0.12,
           {style.trim, SurfaceType::Wall});
    if (style.surround) {
        surround(mesh, f, o, style.trim);
    }
    crown(mesh, f, o, style);
    if (style.shutters) {
        shutterPair(mesh, f, o, style, random);
    }
}

}  // namespace reflet::kit
