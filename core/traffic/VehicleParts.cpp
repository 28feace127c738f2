// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/VehicleParts.h"

#include "core/math/Geometry.h"
#include "core/traffic/MeshPrimitives.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace reflet {
namespace {

constexpr int kBolted = 20;  // segments from which on a wheel shows its bolts

/// Profile of a tyre, (radius, distance from the inner face): closed, shoulders rounded.
std::vector<glm::vec2> tyreProfile(const WheelSpec& spec) {
    const float r = spec.radius;
    const float w = spec.width;
    const float inner = spec.rimRadius;
    const float s = 0.16F * w;
    return {{inner, 0.0F},
            {r - 2 * s, -0.0F},
            {r - 0.6F * s, 0.25F * s},
            {r - 0.12F * s, s},
            {r, 2 * s},
            {r, 0.5F * w},
            {r, w - 2 * s},
            {r - 0.12F * s, w - s},
            {r - 0.6F * s, w - 0.25F * s},
            {r - 2 * s, w},
            {inner, w},
            {inner, 0.5F * w},
            {inner, 0.0F}};
}

/// The part built with its outer face at +y goes to its side.
PartMesh toSide(PartMesh mesh, float x, float radius, float outer) {
    mesh = moved(std::move(mesh), {x, std::abs(outer), radius});
    return outer > 0.0F ? mesh : mirroredLeftRight(std::move(mesh));
}

PartMesh tyre(const WheelSpec& spec) {
    return lathe(tyreProfile(spec), {0.0F, -spec.width, 0.0F}, {0, 1, 0}, 2 * spec.segments, 0.7F,
                 spec.tyre);
}

/// A spoke from the hub to the rim, tapering, its face slightly dished; angle about y.
PartMesh spoke(const WheelSpec& spec, float angle) {
    const float from = 0.14F * spec.rimRadius;
    const float to = 0.97F * spec.rimRadius;
    PartMesh mesh = gridSurface(9, 8, true, spec.rim, 0.6F, [&](int i, int j) {
        const float t = float(std::min(std::max(i - 1, 0), 6)) / 6.0F;
        const float along = from + (to - from) * t;
        const bool closed = i == 0 || i == 8;
        const float half =
            closed ? 0.0F : spec.rimRadius * (0.075F + 0.06F * (1 - t) * (1 - t) + 0.03F * t * t);
        const float depth = closed ? 0.0F : 0.014F;
        const float dish = -0.022F - 0.02F * (1.0F - t);
        const float a = 2.0F * float(kPi) * (float(j) + 0.5F) / 8.0F;
        return GridPoint{{half * std::cos(a), dish - 0.012F + depth * std::sin(a), along}, {}};
    });
    faceOutwards(mesh);
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    return turned(std::move(mesh), glm::mat3(c, 0, -s, 0, 1, 0, s, 0, c));
}

}  // namespace

PartMesh roadWheel(const WheelSpec& spec, float x, float outer) {
    PartMesh mesh = tyre(spec);
    const float r = spec.rimRadius;
    // The rim's barrel and lip, a dark disc (brake and shadow) behind, the hub cap in front.
    append(mesh, lathe({{r * 1.02F, -0.004F},
                        {r * 1.02F, -0.02F},
                        {r * 0.9F, -0.05F},
                        {r * 0.9F, -0.12F},
                        {r * 0.86F, -0.12F},
                        {r * 0.87F, -0.05F},
                        {r * 0.95F, -0.012F},
                        {r * 0.985F, -0.002F},
                        {r * 1.02F, -0.004F}},
                       {0, 0, 0}, {0, 1, 0}, 2 * spec.segments, 0.6F, spec.rim));
    append(mesh, cylinder({0, -0.13F, 0}, {0, -0.09F, 0}, r * 0.9F, spec.segments, spec.hub));
    append(mesh, cylinder({0, -0.09F, 0}, {0, -0.075F, 0}, r * 0.62F, spec.segments, spec.rim));
    append(mesh, lathe({{0, -0.06F},
                        {r * 0.2F, -0.06F},
                        {r * 0.2F, -0.034F},
                        {r * 0.15F, -0.026F},
                        {0, -0.024F}},
                       {0, 0, 0}, {0, 1, 0}, spec.segments, 0.7F, spec.rim));
    for (int i = 0; i < spec.spokes; ++i) {
        append(mesh, spoke(spec, 2.0F * float(kPi) * float(i) / float(spec.spokes)));
    }
    return toSide(std::move(mesh), x, spec.radius, outer);
}

PartMesh discWheel(const WheelSpec& spec, float x, float outer) {
    PartMesh mesh = tyre(spec);
    const float r = spec.rimRadius;
    append(mesh, lathe({{0, -0.1F},
                        {r * 1.01F, -0.1F},
                        {r * 1.01F, -0.006F},
                        {r * 0.93F, -0.006F},
                        {r * 0.86F, -0.05F},
                        {r * 0.5F, -0.075F},
                        {r * 0.42F, -0.03F},
                        {r * 0.3F, -0.012F},
                        {r * 0.24F, 0.006F},
                        {0, 0.008F}},
                       {0, 0, 0}, {0, 1, 0}, spec.segments, 0.6F, spec.rim));
    const int bolts = spec.segments < kBolted ? 0 : 10;
    for (int i = 0; i < bolts; ++i) {
        const float a = 2.0F * float(kPi) * float(i) / float(bolts);
        const glm::vec3 at(0.36F * r * std::cos(a), -0.03F, 0.36F * r * std::sin(a));
        append(mesh, cylinder(at, at + glm::vec3(0, 0.022F, 0), 0.035F * r + 0.003F, 8, spec.hub));
    }
    return toSide(std::move(mesh), x, spec.radius, outer);
}

PartMesh seatPair(float x, float y, float floor, bool backward, std::uint16_t fabric,
                  std::uint16_t frame) {
    PartMesh mesh;
    for (const float side : {-0.235F, 0.235F}) {
        append(mesh, roundedBox({0.22F, side, 0.45F}, {0.44F, 0.43F, 0.09F}, 0.035F, fabric));
        append(mesh, roundedBox({0.0F, side, 0.80F}, {0.08F, 0.43F, 0.72F}, 0.035F, fabric));
    }
    append(mesh, roundedBox({0.18F, 0.0F, 0.2F}, {0.3F, 0.5F, 0.42F}, 0.0F, frame));
    if (backward) {
        mesh = turnedAround(std::move(mesh));
    }
    return moved(std::move(mesh), {x, y, floor});
}

PartMesh pole(float x, float y, float from, float to, std::uint16_t material) {
    return cylinder({x, y, from}, {x, y, to}, 0.018F, 10, material);
}

VehicleBody toBody(PartMesh mesh, float low, float high) {
    VehicleBody body;
    body.vertices = std::move(mesh.positions);
    body.normals = std::move(mesh.normals);
    body.triangles = std::move(mesh.triangles);
    body.triangleMaterial = std::move(mesh.material);
    body.center = {0.0F, 0.0F, 0.5F * (low + high)};
    return body;
}

}  // namespace reflet
