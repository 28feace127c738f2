// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Tree.h"

#include "core/samples/kit/Foliage.h"
#include "core/samples/kit/Shapes.h"

#include <array>
#include <cmath>

namespace reflet::kit {

namespace {

constexpr std::array kPlane{Paint::LeafPlaneC, Paint::LeafPlaneA, Paint::LeafPlaneB};
constexpr std::array kLinden{Paint::LeafLindenC, Paint::LeafLindenA, Paint::LeafLindenB};
constexpr std::array kPine{Paint::LeafPineC, Paint::LeafPineA, Paint::LeafPineB};
constexpr std::array kCypress{Paint::LeafCypressA, Paint::LeafCypressA, Paint::LeafCypressB};
constexpr std::array kCitrus{Paint::LeafCitrusC, Paint::LeafCitrusA, Paint::LeafCitrusB};
constexpr std::array kOlive{Paint::LeafOliveA, Paint::LeafOliveB};
constexpr std::array kHedge{Paint::HedgeC, Paint::HedgeA, Paint::HedgeB};

constexpr Skin kPlaneBark{Paint::BarkPlane, SurfaceType::Unknown};
constexpr Skin kDarkBark{Paint::BarkDark, SurfaceType::Unknown};

/// Trunk in rings of two barks, then boughs that fan out to the crown.
void trunk(Mesh& mesh, double height, double radius, int sides, Paint bark, Paint other) {
    constexpr int kRings = 6;
    for (int i = 0; i < kRings; ++i) {
        const double z0 = height * i / kRings, z1 = height * (i + 1) / kRings;
        const double flare = i == 0 ? 1.35 : 1.0;
        bar(mesh, {0, 0, z0}, {0, 0, z1}, flare * radius * (1 - 0.05 * i),
            radius * (1 - 0.05 * (i + 1)), sides,
            {i % 2 == 0 ? bark : other, SurfaceType::Unknown});
    }
}

void boughs(Mesh& mesh, double from, const glm::dvec3& reach, int count, double radius, Skin bark,
            Random& random) {
    for (int i = 0; i < count; ++i) {
        const double a = 2.0 * kPi * (i + random.between(-0.2, 0.2)) / count;
        const double lift = random.between(0.75, 1.1);
        const glm::dvec3 start(0, 0, from * random.between(0.88, 1.0));
        const glm::dvec3 end =
            start + glm::dvec3(reach.x * std::cos(a), reach.y * std::sin(a), lift * reach.z);
        const glm::dvec3 middle = 0.5 * (start + end) - glm::dvec3(0, 0, 0.08 * reach.z);
        bar(mesh, start, middle, radius, 0.65 * radius, 5, bark);
        bar(mesh, middle, end, 0.65 * radius, 0.25 * radius, 5, bark);
    }
}

void frond(Mesh& mesh, const glm::dvec3& root, double heading, double lift, double length,
           Random& random) {
    constexpr int kParts = 8;
    const glm::dvec3 out(std::cos(heading), std::sin(heading), 0);
    const glm::dvec3 side(-std::sin(heading), std::cos(heading), 0);
    const auto spine = [&](double t) {  // rises, then hangs over like a parabola
        return root + length * (t * std::cos(0.55 * lift) * out +
                                glm::dvec3(0, 0, t * std::sin(lift) - 0.85 * t * t));
    };
    const Skin stem{Paint::LeafPalmB, SurfaceType::Unknown};
    for (int i = 0; i < kParts; ++i) {
        const double t = (i + 0.4) / kParts;
        const glm::dvec3 at = spine(t), next = spine(t + 0.75 / kParts);
        const glm::dvec3 wide = 0.03 * side;
        mesh.polygon({spine(double(i) / kParts) - wide, spine((i + 1.0) / kParts) - wide,
                      spine((i + 1.0) / kParts) + wide, spine(double(i) / kParts) + wide},
                     stem);
        const double reach = 0.62 * std::sin(kPi * (0.12 + 0.86 * t)) + 0.12;
        for (const double s : {-1.0, 1.0}) {
            for (int k = 0; k < 2; ++k) {
                const glm::dvec3 base = glm::mix(at, next, 0.5 * k);
                const glm::dvec3 tip =
                    base + reach * (s * side + 0.55 * (next - at) / glm::length(next - at)) -
                    glm::dvec3(0, 0, reach * random.between(0.25, 0.55));
                const Paint paint = random.chance(0.5) ? Paint::LeafPalmA : Paint::LeafPalmB;
                mesh.polygon({base, base + 0.6 * (next - at), tip}, {paint, SurfaceType::Unknown});
            }
        }
    }
}

}  // namespace

Mesh planeTree(Random& random) {
    Mesh mesh;
    trunk(mesh, 4.2, 0.3, 9, Paint::BarkPlane, Paint::BarkPlaneB);
    boughs(mesh, 4.2, {2.4, 2.4, 3.0}, 7, 0.17, kPlaneBark, random);
    const LeafStyle style{0.54, 0.3, kPlane};
    crown(mesh, {0, 0, 7.4}, {3.9, 3.9, 3.5}, 30, 28, 1.25, style, random);
    return mesh;
}

Mesh lindenTree(Random& random) {
    Mesh mesh;
    trunk(mesh, 2.9, 0.19, 8, Paint::BarkDark, Paint::BarkDark);
    boughs(mesh, 2.9, {1.2, 1.2, 2.6}, 6, 0.11, kDarkBark, random);
    const LeafStyle style{0.42, 0.35, kLinden};
    crown(mesh, {0, 0, 5.4}, {2.3, 2.3, 2.9}, 24, 27, 0.95, style, random);
    return mesh;
}

Mesh stonePine(Random& random) {
    Mesh mesh;
    trunk(mesh, 7.6, 0.32, 8, Paint::BarkDark, Paint::BarkPalmB);
    boughs(mesh, 7.6, {3.6, 3.6, 2.2}, 9, 0.15, kDarkBark, random);
    const LeafStyle style{0.5, -0.2, kPine};
    crown(mesh, {0, 0, 10.2}, {5.2, 5.2, 1.55}, 40, 25, 1.15, style, random);
    return mesh;
}

Mesh datePalm(Random& random) {
    Mesh mesh;
    for (int i = 0; i < 16; ++i) {  // the scars of old fronds
        const double z = 0.47 * i;
        const Paint paint = i % 2 == 0 ? Paint::BarkPalm : Paint::BarkPalmB;
        bar(mesh, {0, 0, z}, {0, 0, z + 0.47}, i == 0 ? 0.36 : 0.27, 0.23, 9,
            {paint, SurfaceType::Unknown});
    }
    lathe(mesh, {0, 0, 7.3}, {{0.24, 0}, {0.42, 0.4}, {0.3, 0.9}, {0.0, 1.1}}, 9,
          {Paint::BarkPalm, SurfaceType::Unknown});
    for (int i = 0; i < 28; ++i) {
        const double heading = 2.399963 * i + random.between(-0.15, 0.15);
        const double lift = 1.25 - 1.5 * i / 27.0;
        frond(mesh, {0, 0, 8.0}, heading, lift, random.between(2.7, 3.3), random);
    }
    return mesh;
}

Mesh cypress(Random& random) {
    Mesh mesh;
    bar(mesh, {0, 0, 0}, {0, 0, 2}, 0.14, 0.1, 6, kDarkBark);
    const LeafStyle style{0.52, -0.9, kCypress};
    constexpr int kClumps = 30;
    for (int i = 0; i < kClumps; ++i) {
        const double t = (i + 0.5) / kClumps;
        const double r = 0.75 * std::pow(std::sin(kPi * std::pow(0.04 + 0.95 * t, 0.75)), 0.8);
        clump(mesh, {0, 0, 0.7 + 9.3 * t}, {r + 0.1, r + 0.1, 0.45}, 17, style, random);
    }
    return mesh;
}

Mesh orangeTree(Random& random) {
    Mesh mesh;
    trunk(mesh, 1.7, 0.09, 7, Paint::BarkDark, Paint::BarkDark);
    boughs(mesh, 1.7, {0.6, 0.6, 0.9}, 5, 0.05, kDarkBark, random);
    const LeafStyle style{0.23, 0.2, kCitrus};
    crown(mesh, {0, 0, 2.7}, {1.15, 1.15, 1.05}, 22, 22, 0.46, style, random);
    for (int i = 0; i < 14; ++i) {
        const glm::dvec3 d = onSphere(random);
        const glm::dvec3 at = glm::dvec3(0, 0, 2.62) + d * glm::dvec3(1.12, 1.12, 1.0);
        lathe(mesh, at, {{0.0, -0.05}, {0.045, 0.0}, {0.0, 0.05}}, 5,
              {Paint::Orange, SurfaceType::Unknown});
    }
    return mesh;
}

Mesh oliveTree(Random& random) {
    Mesh mesh;
    bar(mesh, {0, 0, 0}, {0.2, 0.1, 1.0}, 0.3, 0.22, 7, kPlaneBark);
    bar(mesh, {0.2, 0.1, 1.0}, {0.1, 0.3, 2.0}, 0.22, 0.15, 7, kPlaneBark);
    boughs(mesh, 1.8, {1.2, 1.2, 1.8}, 6, 0.1, kPlaneBark, random);
    const LeafStyle style{0.3, 0.1, kOlive};
    crown(mesh, {0.1, 0.1, 3.5}, {2.0, 2.0, 1.6}, 24, 34, 0.75, style, random);
    return mesh;
}

Mesh distantTree(Random& random) {
    Mesh mesh;
    bar(mesh, {0, 0, -1}, {0, 0, 2.5}, 0.3, 0.2, 4, kDarkBark);
    const LeafStyle style{1.7, 0.2, kLinden};
    crown(mesh, {0, 0, 5.0}, {3.2, 3.2, 3.2}, 4, 9, 2.0, style, random);
    return mesh;
}

Mesh hedge(Random& random) {
    Mesh mesh;
    const Skin core{Paint::HedgeC, SurfaceType::Unknown};
    block(mesh, {-1.0, -0.3, 1.0, 0.3}, 0, 0.94, core, core);
    const LeafStyle style{0.2, 0.0, kHedge};
    for (int i = 0; i < 85; ++i) {
        const double x = random.between(-1.0, 1.0);
        const bool onTop = random.chance(0.35);
        const double side = random.chance(0.5) ? 1.0 : -1.0;
        const double z = onTop ? 0.96 : random.between(0.05, 0.95);
        const double y = onTop ? random.between(-0.32, 0.32) : side * 0.33;
        leaf(mesh, {x, y, z}, onTop ? glm::dvec3(0, 0, 1.5) : glm::dvec3(0, 1.5 * side, 0.4), style,
             0.35 + 0.5 * z, random);
    }
    return mesh;
}

Mesh flowerBed(Paint blossom, Random& random) {
    Mesh mesh;
    lathe(mesh, {0, 0, 0}, {{1.2, 0}, {1.2, 0.14}, {1.08, 0.14}}, 16,
          {Paint::Granite, SurfaceType::Unknown});
    disc(mesh, {0, 0, 0.1}, 1.1, 16, {Paint::Soil, SurfaceType::Unknown});
    const LeafStyle green{0.2, -0.4, kHedge};
    const std::array petals{blossom, blossom, Paint::FlowerWhite};
    const LeafStyle bloom{0.13, 0.0, petals};
    for (int i = 0; i < 95; ++i) {
        const double r = 1.05 * std::sqrt(random.unit()), a = random.between(0, 2 * kPi);
        const glm::dvec3 at(r * std::cos(a), r * std::sin(a), 0.14 + 0.12 * random.unit());
        leaf(mesh, at, {0, 0, 0.6}, green, 0.6, random);
        if (i % 5 < 3) {
            leaf(mesh, at + glm::dvec3(0, 0, 0.12), {0, 0, 1.5}, bloom, 0.4, random);
        }
    }
    return mesh;
}

Mesh treeOfTriangles(std::size_t triangles, double height, Random& random) {
    Mesh mesh;
    const double scale = height / 11.0;
    trunk(mesh, 4.0 * scale, 0.34 * scale, 12, Paint::BarkPlane, Paint::BarkPlaneB);
    boughs(mesh, 4.0 * scale, glm::dvec3(2.6, 2.6, 3.2) * scale, 11, 0.17 * scale, kPlaneBark,
           random);
    const LeafStyle style{0.17 * scale, 0.3, kPlane};
    // The crown's clumps share the leaves that are left; each leaf has two triangles.
    constexpr int kClumps = 60;
    for (int i = 0; i < kClumps; ++i) {
        const glm::dvec3 d = onSphere(random);
        const double r = std::cbrt(random.between(0.3, 1.0));
        const glm::dvec3 at =
            glm::dvec3(0, 0, 7.3 * scale) + r * d * glm::dvec3(3.4, 3.4, 2.9) * scale;
        const std::size_t left = triangles - mesh.triangleCount();
        const int leaves = int(left / 2 / std::size_t(kClumps - i));
        clump(mesh, at, glm::dvec3(1.3, 1.3, 1.0) * scale, leaves, style, random);
    }
    return mesh;
}

}  // namespace reflet::kit
