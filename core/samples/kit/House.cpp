// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/House.h"

#include "core/samples/kit/Ornament.h"
#include "core/samples/kit/ShopFront.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace reflet::kit {

namespace {

int bayCount(const Facade& f, double wanted) {
    return std::max(1, int(std::lround(f.length / wanted)));
}

WindowStyle windowOf(const HouseStyle& style, std::size_t storey, double height) {
    WindowStyle w;
    w.wall = style.wall;
    w.trim = style.trim;
    w.shutter = style.shutter;
    w.shutterDark = style.shutterDark;
    w.width = style.grand ? 1.3 : 1.1;
    w.height = std::min(2.35, height - 1.35);
    w.detail = style.detail;
    w.surround = style.detail != Detail::Low;
    const bool last = storey + 1 == style.storeys.size();
    if (style.grand && storey == 0) {
        w.height = std::min(2.7, height - 1.1);
        w.shutters = false;
        w.paneRows = 3;
    } else if (style.grand && last) {
        w.height = 1.5;
    }
    return w;
}

void storey(Mesh& mesh, const Facade& f, double v, std::size_t number, const HouseStyle& style,
            Random& random) {
    const double height = style.storeys[number];
    WindowStyle w = windowOf(style, number, height);
    const bool french = style.grand && number == 0;
    const double sill = v + (french ? 0.12 : height - w.height - 0.55);
    const int bays = bayCount(f, style.bay);
    const double bay = f.length / bays;
    std::vector<Field> openings;
    for (int i = 0; i < bays; ++i) {
        openings.push_back(windowOpening(w, (i + 0.5) * bay, sill));
    }
    pierced(mesh, f, v, v + height, openings, {style.wall, SurfaceType::Wall});
    const bool balconies =
        french || (style.detail == Detail::Middle && number == 1 && random.chance(0.6));
    for (int i = 0; i < bays; ++i) {
        if (style.grand && number < 2) {
            w.crown = number == 1 ? Crown::Hood : i % 2 == 0 ? Crown::Pediment : Crown::Hood;
        }
        const double center = (i + 0.5) * bay;
        window(mesh, f, center, sill, w, random);
        if (balconies && (french || random.chance(0.75))) {
            balcony(mesh, f, center - 1.15, center + 1.15, v + (french ? 0.1 : sill - v - 0.02),
                    french ? 0.9 : 0.55, style.trim);
        }
    }
}

void shops(Mesh& mesh, const Facade& f, const HouseStyle& style, Random& random) {
    const double top = std::min(3.6, style.groundHeight - 0.7);
    const int bays = bayCount(f, style.bay * 1.25);
    const double bay = f.length / bays;
    std::vector<Field> openings;
    for (int i = 0; i < bays; ++i) {
        openings.push_back({i * bay + 0.4, (i + 1) * bay - 0.4, 0, top});
    }
    pierced(mesh, f, 0, style.groundHeight, openings, {Paint::Stone, SurfaceType::Wall});
    static constexpr std::array kCloth{Paint::AwningRed, Paint::AwningGreen, Paint::AwningBlue,
                                       Paint::AwningOchre};
    const Paint cloth = random.pick(kCloth);
    for (const Field& o : openings) {
        shopFront(mesh, f, o.u0, o.u1, top, random);
        if (style.awnings && random.chance(0.6)) {
            awning(mesh, f, o.u0 - 0.1, o.u1 + 0.1, top - 0.55, 1.35, cloth);
        }
    }
}

void groundFloor(Mesh& mesh, const Facade& f, const HouseStyle& style, Treatment treatment,
                 Random& random) {
    if (treatment == Treatment::Arcade) {
        arcade(mesh, f, bayCount(f, style.bay), style.arcade, random);
        return;
    }
    if (treatment == Treatment::Shops) {
        shops(mesh, f, style, random);
        return;
    }
    WindowStyle w = windowOf(style, 1, style.groundHeight);
    w.height = std::min(2.2, style.groundHeight - 1.8);
    w.crown = Crown::None;
    const int bays = bayCount(f, style.bay);
    const double bay = f.length / bays;
    std::vector<Field> openings;
    for (int i = 0; i < bays; ++i) {
        openings.push_back(windowOpening(w, (i + 0.5) * bay, 1.15));
    }
    pierced(mesh, f, 0, style.groundHeight, openings, {Paint::Stone, SurfaceType::Wall});
    for (int i = 0; i < bays; ++i) {
        window(mesh, f, (i + 0.5) * bay, 1.15, w, random);
    }
    relief(mesh, f, {0, f.length, 0, 0.6}, 0, 0.06, {Paint::StoneBase, SurfaceType::Wall});
}

void front(Mesh& mesh, const Facade& f, const HouseStyle& style, Treatment treatment,
           Random& random) {
    groundFloor(mesh, f, style, treatment, random);
    const double eaves = eavesHeight(style);
    double v = style.groundHeight;
    for (std::size_t i = 0; i < style.storeys.size(); ++i) {
        storey(mesh, f, v, i, style, random);
        stringCourse(mesh, f, v - 0.12, i == 0 ? 0.26 : 0.12, i == 0 ? 0.14 : 0.06, style.trim);
        v += style.storeys[i];
    }
    if (style.grand || (style.detail == Detail::Middle && random.chance(0.4))) {
        quoins(mesh, f, style.groundHeight + 0.3, v - 0.05, style.trim);
    }
    panel(mesh, f, {0, f.length, v, eaves}, 0, {style.wall, SurfaceType::Wall});
    cornice(mesh, f, v, style.grand ? 0.8 : style.detail == Detail::Low ? 6.0 : 1.4, style.trim);
}

/// The arcade's front begins at the plot's edge, its room lies behind: the sides close over it.
void side(Mesh& mesh, const Facade& f, const HouseStyle& style, Treatment treatment,
          Random& random) {
    const double eaves = eavesHeight(style);
    switch (treatment) {
        case Treatment::Party:
            panel(mesh, f, {0, f.length, 0, eaves}, 0, {style.wall, SurfaceType::Wall});
            return;
        case Treatment::Rear:
            panel(mesh, f, {0, f.length, 0, eaves}, 0, {Paint::None, SurfaceType::Wall});
            return;
        default:
            front(mesh, f, style, treatment, random);
    }
}

void roofThings(Mesh& mesh, const Plot& plot, double z, const HouseStyle& style, const Sides& sides,
                Random& random) {
    const double eaves = z + eavesHeight(style);
    const int chimneys = 1 + int((plot.width() + plot.depth()) / 18.0);
    for (int i = 0; i < chimneys; ++i) {
        const double x = random.between(plot.x0 + 1.5, plot.x1 - 1.5);
        const double y = random.between(plot.y0 + 1.5, plot.y1 - 1.5);
        const double slope = eaves + roofHeightAt(plot, style.roof, x, y);
        chimney(mesh, {x, y}, slope - 0.8, slope + random.between(1.1, 1.7), style.wall);
    }
    if (!style.dormers) {
        return;
    }
    for (std::size_t s = 0; s < 4; ++s) {
        const bool alongRidge = style.roof.alongX ? s % 2 == 0 : s % 2 == 1;
        if (!alongRidge || sides[s] == Treatment::Rear || sides[s] == Treatment::Party) {
            continue;
        }
        const Facade f = facadeOf(plot, Side(s), z);
        const int bays = bayCount(f, style.bay);
        for (int i = 1; i + 1 < bays; i += 3) {
            const double back = 1.1;
            const double v = eavesHeight(style) + style.roof.pitch * (back + style.roof.overhang);
            dormer(mesh, f, (i + 0.5) * f.length / bays, back, v - 0.02, style.roof.pitch,
                   style.wall, random);
        }
    }
}

}  // namespace

double eavesHeight(const HouseStyle& style) {
    return std::accumulate(style.storeys.begin(), style.storeys.end(), style.groundHeight) +
           kCorniceHeight;
}

void house(Mesh& mesh, const Plot& plot, double z, const HouseStyle& style, const Sides& sides,
           Random& random) {
    for (std::size_t s = 0; s < 4; ++s) {
        side(mesh, facadeOf(plot, Side(s), z), style, sides[s], random);
    }
    tiledRoof(mesh, plot, z + eavesHeight(style), style.roof, random);
    roofThings(mesh, plot, z, style, sides, random);
}

}  // namespace reflet::kit
