// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/BuiltInVehicles.h"
#include "core/traffic/MeshPrimitives.h"
#include "core/traffic/MeshThinning.h"
#include "core/traffic/VehicleParts.h"
#include "core/traffic/VehicleShell.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

enum BusMaterial : std::uint16_t {
    Livery,
    Silver,
    GlossBlack,
    Glass,
    Rubber,
    Dark,
    Tyre,
    Rim,
    Fabric,
    Trim,
    PoleYellow,
    HeadLight,
    TailLight,
    Ceiling,
    Display,
    Indicator,
    Plate,
    PlateText,
};

std::vector<VehicleMaterial> busMaterials() {
    return {
        {"green paint", {0.010F, 0.085F, 0.040F}, 1.0F, 0.0F, 0.0F, {}},
        {"silver paint", {0.52F, 0.54F, 0.55F}, 0.9F, 0.12F, 0.0F, {}},
        {"black mask", {0.006F, 0.0065F, 0.007F}, 1.0F, 0.0F, 0.0F, {}},
        {"window", {0.46F, 0.51F, 0.51F}, 0.0F, 0.22F, 1.0F, {}},
        {"rubber", {0.012F, 0.012F, 0.013F}, 0.0F, 0.0F, 0.0F, {}},
        {"dark", {0.020F, 0.020F, 0.021F}, 0.0F, 0.0F, 0.0F, {}},
        {"tyre", {0.020F, 0.020F, 0.020F}, 0.0F, 0.0F, 0.0F, {}},
        {"wheel", {0.42F, 0.43F, 0.44F}, 0.3F, 0.2F, 0.0F, {}},
        {"seat fabric", {0.03F, 0.16F, 0.09F}, 0.0F, 0.0F, 0.0F, {}},
        {"interior trim", {0.50F, 0.50F, 0.48F}, 0.0F, 0.0F, 0.0F, {}},
        {"yellow pole", {0.80F, 0.48F, 0.02F}, 0.0F, 0.0F, 0.0F, {}},
        {"headlight", {0.9F, 0.9F, 0.9F}, 0.5F, 0.0F, 0.0F, {2.2F, 2.2F, 2.1F}},
        {"tail light", {0.5F, 0.01F, 0.01F}, 0.9F, 0.0F, 0.0F, {0.40F, 0.010F, 0.008F}},
        {"ceiling light", {0.8F, 0.8F, 0.8F}, 0.0F, 0.0F, 0.0F, {0.5F, 0.48F, 0.44F}},
        {"display", {0.02F, 0.01F, 0.0F}, 0.0F, 0.0F, 0.0F, {1.5F, 0.72F, 0.06F}},
        {"indicator", {0.6F, 0.25F, 0.02F}, 0.9F, 0.0F, 0.0F, {0.12F, 0.045F, 0.0F}},
        {"number plate", {0.80F, 0.80F, 0.78F}, 0.3F, 0.0F, 0.0F, {}},
        {"plate text", {0.01F, 0.01F, 0.012F}, 0.0F, 0.0F, 0.0F, {}},
    };
}

constexpr float kHalfLength = 6.0F, kBottom = 0.26F, kFloor = 0.36F, kRoof = 2.98F, kSill = 1.02F,
                kHeader = 2.58F;
constexpr float kFrontAxle = 3.25F, kRearAxle = -2.70F, kWheelRadius = 0.48F, kArch = 0.56F;
constexpr float kDoors[] = {4.72F, 0.30F};
constexpr float kDoorHalf = 0.64F, kDoorBottom = 0.31F, kDoorTop = 2.46F;

Region band(float x0, float z0, float x1, float z1, float radius) {
    return onSides([=](const glm::vec2& p) {
        return roundedRectangle(p, {x0, z0}, {x1, z1}, radius);
    });
}

Shell busShell() {
    ShellSpec spec;
    spec.halfSection = curvedSection({kBottom, 1.0F, 2.66F, kRoof, 1.275F, 22.0F, 0.20F});
    spec.front.reach =
        Curve{{kBottom, 0.34F}, {0.5F, 0.44F},  {0.8F, 0.46F},  {1.1F, 0.45F}, {1.8F, 0.38F},
              {2.4F, 0.28F},    {2.75F, 0.19F}, {2.92F, 0.10F}, {kRoof, 0.02F}};
    spec.front.base = kHalfLength - 0.46F;
    spec.front.roundness = 3.6F;
    spec.front.rows = 30;
    spec.rear.reach = Curve{{kBottom, 0.12F}, {0.6F, 0.18F}, {1.2F, 0.18F},
                            {2.3F, 0.14F},    {2.8F, 0.09F}, {kRoof, 0.01F}};
    spec.rear.base = -(kHalfLength - 0.18F);
    spec.rear.roundness = 3.6F;
    spec.rear.rows = 20;
    return vehicleShell(spec, Livery);
}

void paintLivery(Shell& shell) {
    // A silver sweep rises from the skirt to the roof behind the rear axle.
    const RoundedPolygon sweep(
        {{-9.0F, 0.0F}, {-2.9F, 0.0F}, {-3.1F, 0.66F}, {-3.7F, 1.9F}, {-4.2F, 3.4F}, {-9.0F, 3.4F}},
        1.6F);
    paint(shell.mesh, onSides([&](const glm::vec2& p) { return sweep.distance(p); }), Silver);
    paint(
        shell.mesh, [](const SurfacePoint& p) { return 2.72F - p.position.z; }, Silver);
    paint(
        shell.mesh, [](const SurfacePoint& p) { return p.position.z - 0.34F; }, Dark);
    paint(shell.mesh, band(-5.72F, kSill, 5.3F, kHeader, 0.10F), GlossBlack);
}

void cutPanes(Shell& shell) {
    constexpr float kEdges[] = {-5.62F, -4.42F, -3.02F, -1.62F, -0.42F, 1.02F, 2.42F, 3.82F};
    for (std::size_t i = 0; i + 1 < std::size(kEdges); ++i) {
        inset(shell.mesh,
              band(kEdges[i] + 0.03F, kSill + 0.07F, kEdges[i + 1] - 0.03F, kHeader - 0.07F, 0.08F),
              0.008F, 0.005F, Rubber, Glass);
    }
    const Region driver = band(4.14F, kSill + 0.07F, 5.12F, kHeader - 0.07F, 0.10F);
    inset(shell.mesh, onOneSide(driver, 1.0F), 0.008F, 0.005F, Rubber, Glass);
    for (const float x : kDoors) {
        const Region opening =
            onOneSide(band(x - kDoorHalf, kDoorBottom, x + kDoorHalf, kDoorTop, 0.06F), -1.0F);
        inset(shell.mesh, opening, 0.014F, 0.014F, Rubber, GlossBlack);
        for (const float side : {-1.0F, 1.0F}) {
            const float a = x + side * 0.045F;
            const float b = x + side * (kDoorHalf - 0.06F);
            const Region pane =
                band(std::min(a, b), kDoorBottom + 0.12F, std::max(a, b), kDoorTop - 0.08F, 0.09F);
            inset(shell.mesh, onOneSide(pane, -1.0F), 0.010F, 0.004F, Rubber, Glass);
        }
        const Region gap = onSides([=](const glm::vec2& p) {
            return std::max(std::abs(p.x - x) - 0.008F, std::abs(p.y - 1.38F) - 1.05F);
        });
        paint(shell.mesh, onOneSide(gap, -1.0F), Rubber);
    }
}

void cutFront(Shell& shell) {
    const float tip = shell.frontTip;
    const auto front = [tip](const RoundedPolygon& shape) {
        return onSides([tip, &shape](const glm::vec2& p) {
            return shape.distance({tip - p.x, p.y});
        });
    };
    const RoundedPolygon mask({{-1.62F, 0.98F},
                               {1.62F, 0.98F},
                               {1.66F, kHeader},
                               {1.36F, 2.90F},
                               {-1.36F, 2.90F},
                               {-1.66F, kHeader}},
                              0.14F);
    paint(shell.mesh, front(mask), GlossBlack);
    const RoundedPolygon screen({{-1.30F, 1.06F},
                                 {1.30F, 1.06F},
                                 {1.34F, 2.5F},
                                 {1.22F, 2.84F},
                                 {-1.22F, 2.84F},
                                 {-1.34F, 2.5F}},
                                0.14F);
    inset(shell.mesh, front(screen), 0.008F, 0.005F, Rubber, Glass);
    const RoundedPolygon lamp({{0.66F, 0.56F},
                               {1.30F, 0.62F},
                               {1.46F, 0.74F},
                               {1.46F, 0.84F},
                               {1.20F, 0.78F},
                               {0.68F, 0.70F}},
                              0.05F);
    inset(shell.mesh, front(lamp), 0.008F, 0.008F, Rubber, GlossBlack);
    for (const float t : {0.82F, 1.06F}) {
        paint(shell.mesh, onSides([=](const glm::vec2& p) {
                  return glm::distance(glm::vec2(tip - p.x, p.y), {t, 0.62F + 0.07F * t}) - 0.055F;
              }),
              HeadLight);
    }
    const RoundedPolygon blinker({{1.22F, 0.68F}, {1.40F, 0.73F}, {1.40F, 0.80F}, {1.22F, 0.75F}},
                                 0.02F);
    paint(shell.mesh, front(blinker), Indicator);
    const RoundedPolygon grille({{-0.52F, 0.36F}, {0.52F, 0.36F}, {0.56F, 0.50F}, {-0.56F, 0.50F}},
                                0.04F);
    inset(shell.mesh, front(grille), 0.010F, 0.02F, Rubber, Dark);
}

void cutRear(Shell& shell) {
    const float tip = shell.rearTip;
    const auto rear = [tip](const RoundedPolygon& shape) {
        return onSides([tip, &shape](const glm::vec2& p) {
            return shape.distance({p.x - tip, p.y});
        });
    };
    const RoundedPolygon window({{-0.95F, 1.62F}, {0.95F, 1.62F}, {0.95F, 2.44F}, {-0.95F, 2.44F}},
                                0.12F);
    paint(shell.mesh, onSides([&](const glm::vec2& p) {
              return window.distance({p.x - tip, p.y}) - 0.05F;
          }),
          GlossBlack);
    inset(shell.mesh, rear(window), 0.008F, 0.005F, Rubber, Glass);
    const RoundedPolygon lamps({{1.06F, 0.72F}, {1.24F, 0.72F}, {1.24F, 1.38F}, {1.06F, 1.38F}},
                               0.05F);
    inset(shell.mesh, rear(lamps), 0.008F, 0.006F, Rubber, TailLight);
    const RoundedPolygon blinker({{1.08F, 1.16F}, {1.22F, 1.16F}, {1.22F, 1.26F}, {1.08F, 1.26F}},
                                 0.02F);
    paint(shell.mesh, rear(blinker), Indicator);
    const RoundedPolygon hood({{-0.92F, 0.52F}, {0.92F, 0.52F}, {0.92F, 1.44F}, {-0.92F, 1.44F}},
                              0.06F);
    outline(shell.mesh, rear(hood), 0.010F, Rubber);
    for (int i = 0; i < 5; ++i) {
        const float z = 0.62F + 0.07F * float(i);
        const RoundedPolygon slot(
            {{-0.70F, z}, {0.70F, z}, {0.70F, z + 0.035F}, {-0.70F, z + 0.035F}}, 0.012F);
        inset(shell.mesh, rear(slot), 0.006F, 0.008F, Rubber, Dark);
    }
}

PartMesh wheels(Shell& shell) {
    PartMesh mesh;
    for (const float x : {kFrontAxle, kRearAxle}) {
        const Region arch = [x](const SurfacePoint& p) {
            const float r =
                glm::distance(glm::vec2(p.position.x, p.position.z), {x, kWheelRadius}) - kArch;
            return std::max(r, 0.6F - std::abs(p.position.y));
        };
        paint(
            shell.mesh, [&](const SurfacePoint& p) { return arch(p) - 0.03F; }, Dark);
        removeInside(shell.mesh, arch);
        PartMesh house = lathe({{kArch + 0.002F, 0.0F},
                                {kArch + 0.03F, 0.0F},
                                {kArch + 0.03F, 0.62F},
                                {kArch + 0.002F, 0.62F},
                                {kArch + 0.002F, 0.0F}},
                               {x, 0.62F, kWheelRadius}, {0, 1, 0}, 64, 0.6F, Rubber);
        append(house, cylinder({x, 0.58F, kWheelRadius}, {x, 0.62F, kWheelRadius}, kArch + 0.02F,
                               48, Rubber));
        removeInside(house, [](const SurfacePoint& p) { return p.position.z - 0.28F; });
        append(mesh, house);
        append(mesh, mirroredLeftRight(house));
        WheelSpec wheel;
        wheel.radius = kWheelRadius;
        wheel.width = x > 0.0F ? 0.29F : 0.56F;
        wheel.rimRadius = 0.30F;
        wheel.tyre = Tyre;
        wheel.rim = Rim;
        wheel.hub = Dark;
        append(mesh, discWheel(wheel, x, 1.21F));
        append(mesh, discWheel(wheel, x, -1.21F));
    }
    return mesh;
}

PartMesh interior() {
    PartMesh mesh;
    append(mesh, roundedBox({-0.3F, 0, kFloor - 0.03F}, {10.8F, 2.36F, 0.05F}, 0.01F, Dark));
    append(mesh, roundedBox({-0.2F, 0, 2.66F}, {10.6F, 2.1F, 0.04F}, 0.01F, Trim));
    for (const float side : {-0.62F, 0.62F}) {
        append(mesh, roundedBox({-0.2F, side, 2.62F}, {10.2F, 0.13F, 0.05F}, 0.015F, Ceiling));
    }
    for (const float x : {-5.0F, -4.2F, -3.4F, -2.5F, -1.6F, 1.5F, 2.3F, 3.2F}) {
        const float step =
            std::abs(x - kRearAxle) < 1.3F || x < -4.0F || std::abs(x - kFrontAxle) < 0.8F ? 0.32F
                                                                                           : 0.0F;
        for (const float side : {-0.80F, 0.80F}) {
            append(mesh, seatPair(x, side, kFloor + step, false, Fabric, Trim));
        }
    }
    for (const float x : {-0.45F, 1.05F, 4.0F, -2.1F}) {
        for (const float side : {-0.62F, 0.62F}) {
            append(mesh, pole(x, side, kFloor, 2.64F, PoleYellow));
        }
    }
    append(mesh, roundedBox({5.25F, 0.55F, 0.98F}, {0.5F, 0.95F, 0.26F}, 0.10F,
                            Rubber));  // driver's desk
    append(mesh, roundedBox({4.62F, 0.60F, 0.95F}, {0.5F, 0.5F, 0.12F}, 0.05F, Dark));
    append(mesh, roundedBox({4.38F, 0.60F, 1.38F}, {0.12F, 0.5F, 0.85F}, 0.05F, Dark));
    append(mesh, lathe({{0.215F, -0.014F},
                        {0.229F, 0.0F},
                        {0.215F, 0.014F},
                        {0.201F, 0.0F},
                        {0.215F, -0.014F}},
                       {5.02F, 0.60F, 1.20F}, {-0.5F, 0.0F, 0.8F}, 40, 2.0F, Rubber));
    append(mesh, roundedBox({4.12F, 0.62F, 1.2F}, {0.04F, 1.1F, 1.7F}, 0.01F, Dark));
    for (const float x : {kFrontAxle, kRearAxle}) {  // nothing where the wheels turn
        removeInside(mesh, [x](const SurfacePoint& p) {
            const float r = glm::distance(glm::vec2(p.position.x, p.position.z), {x, kWheelRadius});
            return std::max(r - kArch - 0.015F, 0.59F - std::abs(p.position.y));
        });
    }
    return mesh;
}

PartMesh details() {
    PartMesh mesh;
    append(mesh, roundedBox({2.3F, 0, 3.05F}, {2.5F, 1.75F, 0.30F}, 0.11F, Silver));
    append(mesh, roundedBox({-1.9F, 0, 3.06F}, {4.2F, 1.9F, 0.32F}, 0.11F, Silver));
    for (float x = -3.7F; x < 0.0F; x += 0.62F) {
        append(mesh, roundedBox({x + 0.2F, 0, 3.07F}, {0.42F, 1.912F, 0.09F}, 0.004F, Dark));
    }
    PartMesh mirror = tube({{5.72F, 1.06F, 2.70F}, {5.98F, 1.20F, 2.62F}, {6.06F, 1.30F, 2.44F}},
                           0.022F, 12, GlossBlack);
    append(mirror, roundedBox({6.02F, 1.34F, 2.22F}, {0.12F, 0.22F, 0.40F}, 0.05F, GlossBlack));
    append(mesh, mirror);
    append(mesh, mirroredLeftRight(mirror));
    const char* text = "12 GARE";
    const float pitch = 0.025F;
    const float width = float(dotTextWidth(text)) * pitch;
    append(mesh, roundedBox({5.62F, 0, 2.66F}, {0.06F, 1.7F, 0.28F}, 0.02F, Rubber));
    append(mesh,
           dotText(text, {5.655F, -0.5F * width, 2.57F}, {0, 1, 0}, {0, 0, 1}, pitch, Display));
    append(mesh, roundedBox({6.0F, 0, 0.60F}, {0.03F, 0.52F, 0.11F}, 0.006F, Plate));
    append(mesh, roundedBox({-6.0F, 0, 0.43F}, {0.03F, 0.52F, 0.11F}, 0.006F, Plate));
    const char* number = "RF 1200";
    const float dots = 0.0098F;
    const float span = float(dotTextWidth(number)) * dots;
    append(mesh,
           dotText(number, {6.0165F, -0.5F * span, 0.567F}, {0, 1, 0}, {0, 0, 1}, dots, PlateText));
    append(mesh, dotText(number, {-6.0165F, 0.5F * span, 0.397F}, {0, -1, 0}, {0, 0, 1}, dots,
                         PlateText));
    // Two wipers at rest.
    for (const float y : {0.1F, -0.9F}) {
        append(mesh, tube({{6.0F, y, 1.02F}, {6.015F, y + 0.35F, 1.12F}, {5.98F, y + 0.8F, 1.16F}},
                          0.012F, 8, Rubber));
    }
    return mesh;
}

/// A half of the bus as a body: moved so that its middle is its origin, both halves on the axles.
VehicleBody half(PartMesh mesh, float middle) {
    VehicleBody body = toBody(moved(std::move(mesh), {-middle, 0, 0}), kBottom, kRoof);
    body.offset = double(middle);
    body.pivotSpan = double(kFrontAxle - kRearAxle);
    body.pivotMiddle = 0.5 * double(kFrontAxle + kRearAxle) - double(middle);
    return body;
}

}  // namespace

Vehicle makeBus() {
    Shell shell = busShell();
    paintLivery(shell);
    cutFront(shell);
    cutRear(shell);
    cutPanes(shell);
    thin(shell.mesh, kThinning);
    PartMesh mesh = wheels(shell);
    append(mesh, shell.mesh);
    append(mesh, interior());
    append(mesh, details());
    Vehicle bus;
    bus.name = "bus";
    bus.materials = busMaterials();
    SplitMesh halves = splitAcross(std::move(mesh));
    bus.bodies.push_back(half(std::move(halves.front), 0.5F * kHalfLength));
    bus.bodies.push_back(half(std::move(halves.rear), -0.5F * kHalfLength));
    return bus;
}

}  // namespace reflet
