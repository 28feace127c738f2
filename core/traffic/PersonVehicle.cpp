// SPDX-License-Identifier: GPL-3.0-or-later
// People on foot: torso and head, two legs, two arms, each a body of its own, so that limbs swing.
#include "core/math/Geometry.h"
#include "core/traffic/BuiltInVehicles.h"
#include "core/traffic/MeshPrimitives.h"
#include "core/traffic/VehicleParts.h"

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

enum Material : std::uint16_t { kSkin, kHair, kTop, kBottom, kShoe };

struct Clothes {
    glm::vec3 hair, top, bottom, shoe;
};

struct Build {
    const char* name;
    float size = 1.0F;  ///< 1: 1.77 m tall
    float head = 1.0F;  ///< of a grown-up's, in proportion
    float shoulders = 1.0F;
    bool longHair = false;
    bool skirt = false;
    Clothes clothes;
};

/// A ring of a limb or torso: an ellipse across the vertical.
struct Ring {
    float z, depth, width;  ///< half axes along x and y
    float x = 0.0F, y = 0.0F;
};

PartMesh loft(const std::vector<Ring>& rings, int around, std::uint16_t material) {
    const int rows = int(rings.size()) + 2;
    PartMesh mesh = gridSurface(rows, around, true, material, 1.2F, [&](int row, int column) {
        const Ring& ring = rings[std::size_t(std::clamp(row - 1, 0, rows - 3))];
        const bool closed = row == 0 || row == rows - 1;
        const float a = 2.0F * float(kPi) * float(column) / float(around);
        const float size = closed ? 0.0F : 1.0F;
        return GridPoint{{ring.x + size * ring.depth * std::cos(a),
                          ring.y + size * ring.width * std::sin(a), ring.z},
                         {}};
    });
    faceOutwards(mesh);
    return mesh;
}

PartMesh torso(const Build& build) {
    const float w = build.shoulders;
    PartMesh mesh = loft({{1.00F, 0.112F, 0.150F},
                          {1.10F, 0.105F, 0.142F * w},
                          {1.22F, 0.118F, 0.165F * w},
                          {1.34F, 0.118F, 0.190F * w},
                          {1.41F, 0.100F, 0.178F * w},
                          {1.455F, 0.070F, 0.110F},
                          {1.475F, 0.050F, 0.060F}},
                         20, kTop);
    if (build.skirt) {
        append(mesh, loft({{0.52F, 0.185F, 0.215F},
                           {0.70F, 0.165F, 0.200F},
                           {0.90F, 0.135F, 0.178F},
                           {1.02F, 0.108F, 0.146F}},
                          20, kBottom));
    } else {
        append(mesh, loft({{0.84F, 0.080F, 0.120F},
                           {0.90F, 0.115F, 0.165F},
                           {0.97F, 0.118F, 0.165F},
                           {1.03F, 0.110F, 0.150F}},
                          20, kBottom));
    }
    const float h = build.head;
    append(mesh, loft({{1.44F, 0.048F, 0.050F}, {1.55F, 0.045F, 0.047F, 0.01F}}, 12, kSkin));
    append(mesh,
           ellipsoid({0.015F, 0.0F, 1.635F}, h * glm::vec3(0.098F, 0.077F, 0.125F), 20, kSkin));
    append(mesh, ellipsoid({0.118F * h, 0.0F, 1.62F}, h * glm::vec3(0.016F, 0.013F, 0.024F), 8,
                           kSkin));  // the nose
    append(mesh,
           ellipsoid({-0.016F, 0.0F, 1.672F}, h * glm::vec3(0.100F, 0.086F, 0.106F), 20, kHair));
    if (build.longHair)
        append(mesh, loft({{1.42F, 0.030F, 0.070F, -0.085F},
                           {1.52F, 0.045F, 0.088F, -0.065F},
                           {1.64F, 0.060F, 0.088F, -0.045F}},
                          14, kHair));
    return mesh;
}

PartMesh leg(const Build& build, float side) {
    const float y = 0.088F * side;
    const std::uint16_t cloth = build.skirt ? kSkin : kBottom;
    const float thick = build.skirt ? 0.82F : 1.0F;
    const auto ring = [&](float z, float radius, float x) {
        return Ring{z, thick * radius, thick * radius, x, y};
    };
    PartMesh mesh = loft(
        {ring(0.07F, 0.050F, -0.01F), ring(0.28F, 0.055F, -0.012F), ring(0.40F, 0.060F, -0.005F),
         ring(0.49F, 0.062F, 0.008F), ring(0.70F, 0.076F, 0.0F), ring(0.92F, 0.084F, 0.0F)},
        14, cloth);
    append(mesh, roundedBox({0.045F, y, 0.045F}, {0.265F, 0.095F, 0.09F}, 0.03F, kShoe));
    return mesh;
}

PartMesh arm(const Build& build, float side) {
    const float shoulder = 0.188F * build.shoulders;
    const auto ring = [&](float z, float radius, float x, float out) {
        return Ring{z, radius, radius, x, side * (shoulder + out)};
    };
    PartMesh mesh = loft({ring(0.86F, 0.034F, 0.03F, 0.062F), ring(1.00F, 0.040F, 0.012F, 0.055F),
                          ring(1.12F, 0.044F, -0.005F, 0.045F), ring(1.28F, 0.050F, 0.0F, 0.030F),
                          ring(1.39F, 0.058F, 0.0F, 0.012F), ring(1.43F, 0.036F, 0.0F, 0.0F)},
                         12, kTop);
    append(mesh, ellipsoid({0.04F, side * (shoulder + 0.064F), 0.80F}, {0.042F, 0.026F, 0.085F}, 10,
                           kSkin));
    return mesh;
}

Vehicle person(const Build& build) {
    Vehicle vehicle;
    vehicle.name = build.name;
    vehicle.walks = true;
    const auto material = [&](const char* name, const glm::vec3& color) {
        VehicleMaterial m;
        m.name = name;
        m.baseColor = color;
        vehicle.materials.push_back(m);
    };
    material("skin", {0.56F, 0.34F, 0.24F});
    material("hair", build.clothes.hair);
    material("top", build.clothes.top);
    material("bottom", build.clothes.bottom);
    material("shoe", build.clothes.shoe);
    const auto add = [&](PartMesh mesh, float low, float high, double swing, double hinge) {
        for (glm::vec3& p : mesh.positions)
            p *= build.size;
        VehicleBody body = toBody(std::move(mesh), low * build.size, high * build.size);
        body.pivotSpan = 0.1;
        body.swing = swing;
        body.hinge = {0.0, 0.0, hinge * double(build.size)};
        vehicle.bodies.push_back(std::move(body));
    };
    add(torso(build), 0.5F, 1.77F, 0.0, 0.0);
    add(leg(build, 1.0F), 0.0F, 0.92F, 0.42, 0.9);
    add(leg(build, -1.0F), 0.0F, 0.92F, -0.42, 0.9);
    add(arm(build, 1.0F), 0.72F, 1.43F, -0.38, 1.4);
    add(arm(build, -1.0F), 0.72F, 1.43F, 0.38, 1.4);
    return vehicle;
}

}  // namespace

Vehicle makeWoman() {
    return person({"woman",
                   0.955F,
                   1.0F,
                   0.92F,
                   true,
                   true,
                   {{0.10F, 0.045F, 0.02F},
                    {0.62F, 0.08F, 0.07F},
                    {0.05F, 0.06F, 0.12F},
                    {0.06F, 0.04F, 0.03F}}});
}

Vehicle makeMan() {
    return person({"man",
                   1.02F,
                   1.0F,
                   1.06F,
                   false,
                   false,
                   {{0.05F, 0.04F, 0.035F},
                    {0.07F, 0.16F, 0.30F},
                    {0.16F, 0.14F, 0.12F},
                    {0.03F, 0.025F, 0.02F}}});
}

Vehicle makeChild() {
    return person({"child",
                   0.68F,
                   1.28F,
                   0.92F,
                   false,
                   false,
                   {{0.32F, 0.19F, 0.07F},
                    {0.85F, 0.52F, 0.05F},
                    {0.06F, 0.12F, 0.26F},
                    {0.70F, 0.70F, 0.68F}}});
}

}  // namespace reflet
