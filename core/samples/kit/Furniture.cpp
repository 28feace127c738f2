// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Furniture.h"

#include "core/samples/kit/Shapes.h"

#include <array>
#include <cmath>

namespace reflet::kit {

namespace {

constexpr Skin skinOf(Paint paint) {
    return {paint, SurfaceType::Unknown};
}
constexpr Skin kIron = skinOf(Paint::IronGreen);

void globe(Mesh& mesh, const glm::dvec3& center, double r) {
    std::vector<glm::dvec2> profile;
    for (int i = 0; i <= 5; ++i) {
        const double a = kPi * (double(i) / 5 - 0.5);
        profile.emplace_back(r * std::cos(a), r * std::sin(a));
    }
    lathe(mesh, center, profile, 8, skinOf(Paint::LampGlow));
}

void foot(Mesh& mesh, double height) {
    lathe(mesh, {0, 0, 0},
          {{0.27, 0},
           {0.27, 0.18},
           {0.19, 0.26},
           {0.17, 0.75},
           {0.21, 0.82},
           {0.1, 0.95},
           {0.075, 1.1},
           {0.055, height}},
          6, kIron);
}

}  // namespace

Mesh lampPost() {
    Mesh mesh;
    foot(mesh, 4.5);
    lathe(mesh, {0, 0, 3.5}, {{0.06, 0}, {0.11, 0.06}, {0.06, 0.14}}, 8, kIron);
    for (int i = 0; i < 4; ++i) {
        const double a = 0.5 * kPi * i;
        const glm::dvec3 out(std::cos(a), std::sin(a), 0);
        const glm::dvec3 knee = 0.62 * out + glm::dvec3(0, 0, 3.62);
        bar(mesh, {0, 0, 3.85}, knee, 0.03, 0.03, 5, kIron);
        bar(mesh, knee, knee + glm::dvec3(0, 0, 0.3), 0.03, 0.06, 6, kIron);
        globe(mesh, knee + glm::dvec3(0, 0, 0.48), 0.2);
    }
    lathe(mesh, {0, 0, 4.5}, {{0.05, 0}, {0.1, 0.1}, {0.07, 0.2}}, 8, kIron);
    globe(mesh, {0, 0, 4.92}, 0.24);
    return mesh;
}

Mesh streetLamp() {
    Mesh mesh;
    foot(mesh, 3.6);
    lathe(mesh, {0, 0, 3.6}, {{0.05, 0}, {0.12, 0.08}}, 6, kIron);
    lathe(mesh, {0, 0, 3.68}, {{0.12, 0}, {0.22, 0.5}}, 6, skinOf(Paint::LampGlow));
    lathe(mesh, {0, 0, 4.18}, {{0.27, 0}, {0.1, 0.2}, {0.04, 0.24}, {0.0, 0.42}}, 6, kIron);
    return mesh;
}

Mesh lightMast() {
    Mesh mesh;
    lathe(mesh, {0, 0, 0}, {{0.2, 0}, {0.2, 0.35}, {0.11, 0.4}, {0.06, 8.2}}, 10,
          skinOf(Paint::Steel));
    lathe(mesh, {0, 0, 8.2}, {{0.06, 0}, {0.24, 0.12}, {0.24, 0.2}}, 10, skinOf(Paint::Steel));
    lathe(mesh, {0, 0, 8.4}, {{0.2, 0}, {0.2, 1.3}, {0.12, 1.45}, {0.0, 1.5}}, 10,
          skinOf(Paint::LampGlow));
    return mesh;
}

Mesh bench() {
    Mesh mesh;
    const Stand s;
    const Skin wood = skinOf(Paint::WoodSlat);
    for (const double y : {-0.75, 0.75}) {
        box(mesh, s, {-0.25, y - 0.03, 0}, {0.25, y + 0.03, 0.42}, skinOf(Paint::Iron));
        box(mesh, s, {-0.29, y - 0.03, 0.42}, {-0.23, y + 0.03, 0.88}, skinOf(Paint::Iron));
    }
    for (int i = 0; i < 4; ++i) {
        const double x = -0.22 + 0.125 * i;
        box(mesh, s, {x, -0.95, 0.43}, {x + 0.1, 0.95, 0.47}, wood);
    }
    for (int i = 0; i < 3; ++i) {
        const double z = 0.55 + 0.125 * i;
        box(mesh, s, {-0.23, -0.95, z}, {-0.19, 0.95, z + 0.1}, wood);
    }
    return mesh;
}

Mesh bollard() {
    Mesh mesh;
    lathe(mesh, {0, 0, 0}, {{0.09, 0}, {0.08, 0.75}, {0.1, 0.8}, {0.1, 0.88}, {0.0, 0.96}}, 8,
          skinOf(Paint::Iron));
    return mesh;
}

Mesh planter() {
    Mesh mesh;
    const Stand s;
    box(mesh, s, {-0.55, -0.55, 0.05}, {0.55, 0.55, 0.7}, skinOf(Paint::DoorGreen), false);
    box(mesh, s, {-0.6, -0.6, 0.62}, {0.6, 0.6, 0.72}, skinOf(Paint::Trim));
    box(mesh, s, {-0.5, -0.5, 0.7}, {0.5, 0.5, 0.75}, skinOf(Paint::Soil), false);
    for (const double x : {-0.57, 0.57}) {
        for (const double y : {-0.57, 0.57}) {
            lathe(mesh, {x, y, 0.72}, {{0.05, 0}, {0.09, 0.08}, {0.0, 0.2}}, 6,
                  skinOf(Paint::Trim));
        }
    }
    return mesh;
}

Mesh parasol(Paint cloth) {
    Mesh mesh;
    bar(mesh, {0, 0, 0}, {0, 0, 2.75}, 0.03, 0.03, 5, skinOf(Paint::WoodSlat));
    lathe(mesh, {0, 0, 0}, {{0.3, 0}, {0.3, 0.08}, {0.06, 0.1}}, 8, skinOf(Paint::Iron));
    constexpr int kPanels = 8;
    for (int i = 0; i < kPanels; ++i) {
        const double a = 2 * kPi * i / kPanels, b = 2 * kPi * (i + 1) / kPanels;
        const glm::dvec3 p(1.55 * std::cos(a), 1.55 * std::sin(a), 2.2);
        const glm::dvec3 q(1.55 * std::cos(b), 1.55 * std::sin(b), 2.2);
        const glm::dvec3 down(0, 0, 0.18);
        const Skin skin = skinOf(i % 2 == 0 ? cloth : Paint::Parasol);
        mesh.polygon({p, q, {0, 0, 2.72}}, skin);
        mesh.polygon({p - down, q - down, q, p}, skin);
    }
    return mesh;
}

Mesh cafeTable(Random& random) {
    Mesh mesh;
    lathe(mesh, {0, 0, 0}, {{0.24, 0}, {0.04, 0.05}, {0.04, 0.7}}, 6, skinOf(Paint::Iron));
    lathe(mesh, {0, 0, 0.7}, {{0.36, 0}, {0.36, 0.03}}, 12, skinOf(Paint::SignCream));
    disc(mesh, {0, 0, 0.73}, 0.36, 12, skinOf(Paint::SignCream));
    const int chairs = random.integer(2, 4);
    for (int i = 0; i < chairs; ++i) {
        const double a = 2 * kPi * (i + random.between(-0.12, 0.12)) / chairs + 0.6;
        const Stand s{{0.72 * std::cos(a), 0.72 * std::sin(a), 0}, {-std::cos(a), -std::sin(a)}};
        const Skin metal = skinOf(Paint::Chair);
        box(mesh, s, {-0.2, -0.2, 0.44}, {0.2, 0.2, 0.47}, skinOf(Paint::WoodSlat));
        for (const double x : {-0.19, 0.17}) {
            for (const double y : {-0.19, 0.17}) {
                box(mesh, s, {x, y, 0}, {x + 0.02, y + 0.02, x < 0 ? 0.85 : 0.44}, metal, false);
            }
        }
        for (const double z : {0.56, 0.66, 0.76}) {
            box(mesh, s, {-0.195, -0.19, z}, {-0.175, 0.19, z + 0.06}, skinOf(Paint::WoodSlat));
        }
    }
    return mesh;
}

Mesh kiosk() {
    Mesh mesh;
    const Skin green = skinOf(Paint::DoorGreen);
    lathe(mesh, {0, 0, 0}, {{1.65, 0}, {1.65, 0.2}, {1.5, 0.25}, {1.5, 0.95}}, 8, green);
    lathe(mesh, {0, 0, 0.95}, {{1.47, 0}, {1.47, 1.25}}, 8, skinOf(Paint::GlassShop));
    for (int i = 0; i < 8; ++i) {
        const double a = 2 * kPi * (i + 0.5) / 8;
        const glm::dvec3 p(1.5 * std::cos(a), 1.5 * std::sin(a), 0.9);
        bar(mesh, p, p + glm::dvec3(0, 0, 1.4), 0.06, 0.06, 4, green);
    }
    lathe(mesh, {0, 0, 2.2}, {{1.55, 0}, {1.55, 0.45}, {2.0, 0.5}, {2.0, 0.62}}, 8,
          skinOf(Paint::SignCream));
    lathe(mesh, {0, 0, 2.82},
          {{2.0, 0}, {1.5, 0.35}, {1.15, 0.9}, {0.5, 1.15}, {0.25, 1.5}, {0.0, 2.0}}, 8,
          skinOf(Paint::Zinc));
    return mesh;
}

Mesh tramShelter() {
    Mesh mesh;
    const Stand s;
    const Skin steel = skinOf(Paint::Steel);
    for (const double x : {-2.9, 0.0, 2.8}) {
        box(mesh, s, {x, 0.5, 0}, {x + 0.1, 0.6, 2.5}, steel);
    }
    box(mesh, s, {-3.2, -0.9, 2.5}, {3.2, 0.9, 2.62}, steel);
    box(mesh, s, {-2.8, 0.53, 0.3}, {2.8, 0.57, 2.2}, skinOf(Paint::GlassSky));
    box(mesh, s, {-2.2, 0.05, 0.42}, {1.2, 0.45, 0.5}, skinOf(Paint::WoodSlat));
    box(mesh, s, {1.6, 0.2, 0.5}, {2.6, 0.35, 2.1}, skinOf(Paint::SignCream));
    box(mesh, s, {1.66, 0.19, 0.9}, {2.54, 0.2, 2.0}, skinOf(Paint::SignBlue));
    box(mesh, s, {-3.1, -0.95, 2.62}, {-1.2, -0.9, 2.95}, skinOf(Paint::SignBlue));
    return mesh;
}

Mesh litterBin() {
    Mesh mesh;
    lathe(mesh, {0, 0, 0}, {{0.2, 0}, {0.24, 0.8}, {0.25, 0.86}}, 8, kIron);
    disc(mesh, {0, 0, 0.82}, 0.24, 8, skinOf(Paint::Iron));
    return mesh;
}

Mesh parkedCar(Paint body) {
    Mesh mesh;
    constexpr double kHalf = 0.82;
    // Outline of the body and of the glasshouse seen from the right, from the rear clockwise.
    constexpr std::array<glm::dvec2, 8> kBody{{{-1.9, 0.3},
                                               {1.75, 0.3},
                                               {1.95, 0.45},
                                               {1.92, 0.72},
                                               {1.1, 0.92},
                                               {-1.75, 0.95},
                                               {-1.95, 0.8},
                                               {-1.95, 0.45}}};
    constexpr std::array<glm::dvec2, 4> kCabin{
        {{1.05, 0.92}, {0.35, 1.42}, {-1.25, 1.44}, {-1.72, 0.95}}};
    const auto side = [&](const auto& outline, double y, bool left, Skin skin) {
        std::vector<glm::dvec3> ring;
        for (const glm::dvec2& p : outline) {
            ring.emplace_back(p.x, y, p.y);
        }
        if (left) {
            ring = {ring.rbegin(), ring.rend()};
        }
        mesh.polygon(ring, skin);
    };
    const auto strip = [&](const glm::dvec2& a, const glm::dvec2& b, double ya, double yb,
                           Skin skin) {
        mesh.polygon({{a.x, -ya, a.y}, {a.x, ya, a.y}, {b.x, yb, b.y}, {b.x, -yb, b.y}}, skin);
    };
    side(kBody, -kHalf, false, skinOf(body));
    side(kBody, kHalf, true, skinOf(body));
    for (std::size_t i = 0; i < kBody.size(); ++i) {
        strip(kBody[i], kBody[(i + 1) % kBody.size()], kHalf, kHalf, skinOf(body));
    }
    constexpr double kRoofHalf = 0.62;  // the glasshouse narrows upwards
    const Skin glass = skinOf(Paint::GlassDark);
    strip(kCabin[0], kCabin[1], kHalf - 0.06, kRoofHalf, glass);
    strip(kCabin[1], kCabin[2], kRoofHalf, kRoofHalf, skinOf(body));
    strip(kCabin[2], kCabin[3], kRoofHalf, kHalf - 0.06, glass);
    for (const double s : {-1.0, 1.0}) {
        const auto at = [&](std::size_t i, double y) {
            return glm::dvec3(kCabin[i].x, s * y, kCabin[i].y);
        };
        const glm::dvec3 low = 0.5 * (at(0, kHalf - 0.06) + at(3, kHalf - 0.06));
        const glm::dvec3 high = 0.5 * (at(1, kRoofHalf) + at(2, kRoofHalf));
        mesh.polygon({at(0, kHalf - 0.06), at(1, kRoofHalf), high}, glass);
        mesh.polygon({at(0, kHalf - 0.06), high, low}, glass);
        mesh.polygon({low, high, at(2, kRoofHalf)}, glass);
        mesh.polygon({low, at(2, kRoofHalf), at(3, kHalf - 0.06)}, glass);
        bar(mesh, low + glm::dvec3(0, 0.01 * s, 0), high + glm::dvec3(0, 0.01 * s, 0), 0.04, 0.04,
            4, skinOf(body));
        for (const double x : {-1.2, 1.2}) {
            bar(mesh, {x, s * (kHalf - 0.2), 0.31}, {x, s * (kHalf + 0.02), 0.31}, 0.31, 0.31, 8,
                skinOf(Paint::SignDark));
            std::vector<glm::dvec3> tyre, hub;
            for (int i = 0; i < 8; ++i) {
                const double a = -s * 2 * kPi * (i + 0.5) / 8;
                tyre.emplace_back(x + 0.31 * std::cos(a), s * (kHalf + 0.02),
                                  0.31 + 0.31 * std::sin(a));
                hub.emplace_back(x + 0.18 * std::cos(a), s * (kHalf + 0.04),
                                 0.31 + 0.18 * std::sin(a));
            }
            mesh.polygon(tyre, skinOf(Paint::SignDark));
            mesh.polygon(hub, skinOf(Paint::Steel));
        }
        const Stand stand;
        box(mesh, stand, {1.8, s * 0.6 - 0.16, 0.56}, {1.955, s * 0.6 + 0.16, 0.7},
            skinOf(Paint::FrameWhite));
        box(mesh, stand, {-1.965, s * 0.6 - 0.15, 0.62}, {-1.8, s * 0.6 + 0.15, 0.76},
            skinOf(Paint::AwningRed));
    }
    return mesh;
}

Mesh passerBy(Paint coat, Paint legs, Paint hair) {
    Mesh mesh;
    for (const double y : {-0.1, 0.1}) {  // mid-step
        bar(mesh, {y, y, 0.02}, {0.35 * y, 0.85 * y, 0.85}, 0.07, 0.1, 5, skinOf(legs));
        const Stand shoe{{y + 0.05, y, 0}};
        box(mesh, shoe, {-0.12, -0.045, 0}, {0.14, 0.045, 0.09}, skinOf(Paint::Iron), false);
        bar(mesh, {0, 2.25 * y, 1.4}, {-1.5 * y, 2.7 * y, 0.85}, 0.055, 0.045, 5, skinOf(coat));
    }
    lathe(mesh, {0, 0, 0.78},
          {{0.17, 0}, {0.18, 0.2}, {0.16, 0.35}, {0.22, 0.6}, {0.12, 0.72}, {0.06, 0.76}}, 7,
          skinOf(coat));
    lathe(mesh, {0, 0, 1.52}, {{0.05, 0}, {0.09, 0.06}, {0.105, 0.13}}, 7,
          skinOf(Paint::PlasterRose));
    lathe(mesh, {-0.015, 0, 1.65}, {{0.112, 0}, {0.1, 0.07}, {0.05, 0.12}, {0.0, 0.13}}, 7,
          skinOf(hair));
    return mesh;
}

}  // namespace reflet::kit
