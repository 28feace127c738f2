// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/ShopFront.h"

#include "core/samples/kit/Window.h"

#include <algorithm>
#include <cmath>

namespace reflet::kit {

namespace {

/// Strokes of made-up letters: enough to read as writing from across the street.
void lettering(Mesh& mesh, const Facade& f, const Field& board, double w, Paint paint,
               Random& random) {
    const Skin skin{paint, SurfaceType::Wall};
    const double height = 0.52 * (board.v1 - board.v0);
    const double v0 = 0.5 * (board.v0 + board.v1 - height);
    const double wide = 0.62 * height;
    const int room = int((board.u1 - board.u0 - 0.4) / (1.35 * wide));
    const int count = std::min(room, random.integer(5, 10));
    double u = 0.5 * (board.u0 + board.u1) - 0.5 * count * 1.35 * wide;
    const double stroke = 0.17 * height;
    for (int i = 0; i < count; ++i, u += 1.35 * wide) {
        if (i == 4 && random.chance(0.4)) {
            continue;  // a gap between two words
        }
        panel(mesh, f, {u, u + stroke, v0, v0 + height}, w, skin);
        if (random.chance(0.55)) {
            panel(mesh, f, {u + wide - stroke, u + wide, v0, v0 + height}, w, skin);
        }
        for (const double level : {0.0, 0.42, 0.84}) {
            if (random.chance(0.6)) {
                const double v = v0 + level * height;
                panel(mesh, f, {u + stroke, u + wide - stroke, v, v + stroke}, w, skin);
            }
        }
    }
}

void signBoard(Mesh& mesh, const Facade& f, const Field& board, Random& random) {
    static constexpr std::array kBoards{Paint::SignDark,  Paint::SignRed,   Paint::SignBlue,
                                        Paint::DoorGreen, Paint::SignCream, Paint::FrameWood};
    const Paint paint = random.pick(kBoards);
    relief(mesh, f, board, -0.2, 0.06, {paint, SurfaceType::Wall});
    const Paint letters = paint == Paint::SignCream ? Paint::SignRed
                          : random.chance(0.5)      ? Paint::Gold
                                                    : Paint::SignCream;
    lettering(mesh, f, board, 0.09, letters, random);
}

}  // namespace

void shopFront(Mesh& mesh, const Facade& f, double u0, double u1, double height, Random& random) {
    static constexpr std::array kFrames{Paint::FrameWood, Paint::DoorGreen, Paint::SignDark,
                                        Paint::DoorWood, Paint::SignBlue};
    const Paint frame = random.pick(kFrames);
    const Skin frameSkin{frame, SurfaceType::Window};
    constexpr double kBack = -0.2;
    constexpr double kRiser = 0.45;
    const double board = std::min(0.6, 0.2 * height);
    const double top = height - board;
    reveal(mesh, f, {u0, u1, 0, height}, 0.3, {Paint::TrimShade, SurfaceType::Wall});
    const double doorWidth = std::min(1.0, 0.35 * (u1 - u0));
    const bool doorLeft = random.chance(0.5);
    const double doorU = doorLeft ? u0 : u1 - doorWidth;
    const double paneU0 = doorLeft ? u0 + doorWidth : u0;
    const double paneU1 = doorLeft ? u1 : u1 - doorWidth;
    // Door: a wooden lower panel, glass above, a fanlight over it.
    panel(mesh, f, {doorU, doorU + doorWidth, 0, 0.8}, kBack - 0.08, {frame, SurfaceType::Door});
    glazing(mesh, f, {doorU, doorU + doorWidth, 0.8, 2.15}, kBack - 0.05, 1, 1, frame, random);
    glazing(mesh, f, {doorU, doorU + doorWidth, 2.15, top}, kBack - 0.05, 1, 1, frame, random);
    // Window: riser, a pane or two, lights above.
    relief(mesh, f, {paneU0, paneU1, 0, kRiser}, kBack - 0.1, kBack + 0.12, frameSkin);
    const int panes = paneU1 - paneU0 > 2.2 ? 2 : 1;
    const double paneWidth = (paneU1 - paneU0) / panes;
    for (int i = 0; i < panes; ++i) {
        const double u = paneU0 + i * paneWidth;
        relief(mesh, f, {u, u + 0.07, kRiser, top}, kBack - 0.1, kBack + 0.05, frameSkin);
        panel(mesh, f, {u + 0.07, u + paneWidth, kRiser, top - 0.55}, kBack - 0.08,
              {Paint::GlassShop, SurfaceType::Window});
        panel(mesh, f, {u + 0.07, u + paneWidth, top - 0.47, top}, kBack - 0.08,
              {Paint::GlassSky, SurfaceType::Window});
    }
    relief(mesh, f, {paneU0, paneU1, top - 0.55, top - 0.47}, kBack - 0.1, kBack + 0.05, frameSkin);
    signBoard(mesh, f, {u0, u1, top, height}, random);
}

void awning(Mesh& mesh, const Facade& f, double u0, double u1, double v, double out, Paint paint) {
    const int stripes = std::max(3, int(std::lround((u1 - u0) / 0.36)) | 1);
    const double step = (u1 - u0) / stripes;
    const double drop = 0.42 * out;
    for (int i = 0; i < stripes; ++i) {
        const Skin skin{i % 2 == 0 ? paint : Paint::AwningCream, SurfaceType::Unknown};
        const double a = u0 + i * step, b = a + step;
        mesh.polygon(
            {f.at(a, v - drop, out), f.at(b, v - drop, out), f.at(b, v, 0.07), f.at(a, v, 0.07)},
            skin);
        panel(mesh, f, {a, b, v - drop - 0.22, v - drop}, out, skin);
    }
    const Skin edge{paint, SurfaceType::Unknown};
    for (const double u : {u0, u1}) {
        mesh.polygon({f.at(u, v - drop, 0.07), f.at(u, v - drop, out), f.at(u, v, 0.07)}, edge);
    }
}

}  // namespace reflet::kit
