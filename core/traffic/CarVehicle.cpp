// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/BuiltInVehicles.h"
#include "core/traffic/MeshCutting.h"
#include "core/traffic/MeshPrimitives.h"
#include "core/traffic/MeshThinning.h"
#include "core/traffic/PlaneShapes.h"
#include "core/traffic/SplineSurface.h"
#include "core/traffic/VehicleParts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

enum CarMaterial : std::uint16_t {
    Paint,
    Glass,
    GlossBlack,
    Rubber,
    Dark,
    Rim,
    Chrome,
    HeadLight,
    LampGlass,
    TailLight,
    Indicator,
    Plate,
    PlateText,
    Cabin,
};

std::vector<VehicleMaterial> carMaterials() {
    return {
        {"red paint", {0.20F, 0.005F, 0.009F}, 1.0F, 0.12F, 0.0F, {}},
        {"window", {0.40F, 0.46F, 0.45F}, 0.0F, 0.12F, 1.0F, {}},
        {"black trim", {0.008F, 0.008F, 0.009F}, 0.9F, 0.0F, 0.0F, {}},
        {"tyre", {0.018F, 0.018F, 0.019F}, 0.0F, 0.0F, 0.0F, {}},
        {"dark", {0.010F, 0.010F, 0.011F}, 0.0F, 0.0F, 0.0F, {}},
        {"alloy", {0.36F, 0.37F, 0.39F}, 0.5F, 0.45F, 0.0F, {}},
        {"chrome", {0.85F, 0.86F, 0.87F}, 0.0F, 1.0F, 0.0F, {}},
        {"headlight", {0.9F, 0.9F, 0.9F}, 0.6F, 0.0F, 0.0F, {1.9F, 1.95F, 2.0F}},
        {"lamp glass", {0.10F, 0.11F, 0.12F}, 1.0F, 0.25F, 0.0F, {}},
        {"tail light", {0.42F, 0.006F, 0.008F}, 1.0F, 0.0F, 0.0F, {0.22F, 0.004F, 0.004F}},
        {"indicator", {0.55F, 0.20F, 0.02F}, 1.0F, 0.0F, 0.0F, {}},
        {"number plate", {0.80F, 0.80F, 0.78F}, 0.3F, 0.0F, 0.0F, {}},
        {"plate text", {0.01F, 0.01F, 0.012F}, 0.0F, 0.0F, 0.0F, {}},
        {"cabin", {0.035F, 0.034F, 0.033F}, 0.0F, 0.0F, 0.0F, {}},
    };
}

constexpr float kFrontAxle = 1.34F, kRearAxle = -1.28F, kWheelRadius = 0.338F, kArch = 0.385F;

/// A section of the car: heights of sill (low), widest line, shoulder and top; half widths.
struct Section {
    float x, low, waist, shoulder, top;
    float width;  // at the waist
    float shoulderWidth;
    float glassWidth;  // of the cabin's upper edge (or the bonnet's crown)
    float bow;         // how far the sides lie behind the middle line (front > 0)
};

/// From the tail to the nose; the first and the last collapse to a line, which closes the body.
constexpr Section kSections[] = {
    {-2.20F, 0.545F, 0.545F, 0.545F, 0.545F, 0.62F, 0.62F, 0.40F, -0.24F},
    {-2.23F, 0.34F, 0.54F, 0.70F, 0.78F, 0.72F, 0.70F, 0.50F, -0.24F},
    {-2.20F, 0.24F, 0.54F, 0.82F, 0.94F, 0.82F, 0.79F, 0.58F, -0.22F},
    {-2.12F, 0.20F, 0.55F, 0.90F, 1.06F, 0.88F, 0.83F, 0.60F, -0.18F},
    {-1.94F, 0.19F, 0.57F, 0.94F, 1.24F, 0.905F, 0.855F, 0.58F, -0.13F},
    {-1.68F, 0.18F, 0.59F, 0.95F, 1.405F, 0.92F, 0.875F, 0.56F, -0.08F},
    {-1.30F, 0.18F, 0.60F, 0.95F, 1.475F, 0.925F, 0.885F, 0.565F, -0.03F},
    {-0.85F, 0.18F, 0.60F, 0.945F, 1.505F, 0.92F, 0.885F, 0.575F, 0.0F},
    {-0.40F, 0.18F, 0.60F, 0.935F, 1.515F, 0.915F, 0.88F, 0.58F, 0.02F},
    {0.00F, 0.18F, 0.60F, 0.925F, 1.505F, 0.915F, 0.88F, 0.575F, 0.05F},
    {0.36F, 0.18F, 0.60F, 0.915F, 1.455F, 0.915F, 0.88F, 0.57F, 0.10F},
    {0.68F, 0.18F, 0.60F, 0.905F, 1.28F, 0.915F, 0.88F, 0.60F, 0.13F},
    {0.96F, 0.18F, 0.60F, 0.895F, 1.06F, 0.915F, 0.88F, 0.66F, 0.13F},
    {1.18F, 0.18F, 0.60F, 0.88F, 0.965F, 0.92F, 0.88F, 0.66F, 0.11F},
    {1.45F, 0.18F, 0.60F, 0.855F, 0.915F, 0.92F, 0.87F, 0.62F, 0.12F},
    {1.75F, 0.18F, 0.59F, 0.815F, 0.87F, 0.91F, 0.84F, 0.58F, 0.16F},
    {2.00F, 0.19F, 0.57F, 0.755F, 0.815F, 0.88F, 0.80F, 0.54F, 0.22F},
    {2.16F, 0.22F, 0.55F, 0.69F, 0.745F, 0.83F, 0.74F, 0.50F, 0.27F},
    {2.22F, 0.30F, 0.52F, 0.62F, 0.66F, 0.74F, 0.68F, 0.46F, 0.30F},
    {2.20F, 0.50F, 0.50F, 0.50F, 0.50F, 0.64F, 0.62F, 0.40F, 0.30F},
};

std::vector<glm::vec3> controlRow(const Section& s) {
    const float rise = s.top - s.shoulder;
    const float crown = std::min(0.016F, 0.1F * (s.top - s.low));
    const glm::vec2 half[] = {
        {0.0F, s.low},
        {0.55F * s.width, s.low},
        {0.93F * s.width, s.low},
        {0.985F * s.width, s.low + 0.20F * (s.waist - s.low)},
        {0.985F * s.width, s.low + 0.62F * (s.waist - s.low)},
        {1.0F * s.width, s.waist + 0.15F * (s.shoulder - s.waist)},
        {0.995F * s.width, s.waist + 0.72F * (s.shoulder - s.waist)},
        {s.shoulderWidth, s.shoulder + 0.02F * rise},
        {glm::mix(s.shoulderWidth, s.glassWidth, 0.30F), s.shoulder + 0.30F * rise},
        {glm::mix(s.shoulderWidth, s.glassWidth, 0.80F), s.shoulder + 0.80F * rise},
        {s.glassWidth, s.top - 0.02F * rise},
        {0.5F * s.glassWidth, s.top + 0.75F * crown},
        {0.0F, s.top + crown}};
    std::vector<glm::vec3> row;
    for (const glm::vec2& p : half) {
        const float share = p.x / 0.92F;
        row.emplace_back(s.x - s.bow * share * share, p.x, p.y);
    }
    return row;
}

PartMesh carShell() {
    SplineNet net;
    for (const Section& s : kSections) {
        net.rows.push_back(controlRow(s));
    }
    return splineSurface(net, Paint);
}

/// Regions drawn in the side view (x, z), on both sides; in the front view (|y|, z), ahead or
/// behind.
template <class Shape>
Region fromSide(const Shape& shape, float steepest = 0.42F) {
    return [&shape, steepest](const SurfacePoint& p) {
        return std::max(shape.distance({p.position.x, p.position.z}),
                        0.4F * (steepest - std::abs(p.normal.y)));
    };
}
template <class Shape>
Region fromEnd(const Shape& shape, float sign, float steepest = 0.15F) {
    return [&shape, sign, steepest](const SurfacePoint& p) {
        return std::max({shape.distance({std::abs(p.position.y), p.position.z}),
                         0.4F * (steepest - sign * p.normal.x), -sign * p.position.x});
    };
}

void cutWindows(PartMesh& mesh) {
    const RoundedPolygon side({{0.98F, 0.945F},
                               {0.30F, 0.945F},
                               {-1.30F, 0.975F},
                               {-1.72F, 1.06F},
                               {-1.56F, 1.20F},
                               {-1.18F, 1.325F},
                               {-0.60F, 1.385F},
                               {0.02F, 1.375F},
                               {0.34F, 1.31F},
                               {0.62F, 1.17F}},
                              0.05F);
    paint(mesh, fromSide(side), GlossBlack);
    const RoundedPolygon front({{0.72F, 0.978F},
                                {-0.10F, 0.978F},
                                {-0.10F, 1.35F},
                                {0.10F, 1.352F},
                                {0.33F, 1.285F},
                                {0.56F, 1.155F}},
                               0.035F);
    const RoundedPolygon rear(
        {{-0.20F, 0.980F}, {-1.02F, 0.998F}, {-1.04F, 1.325F}, {-0.62F, 1.360F}, {-0.20F, 1.352F}},
        0.03F);
    const RoundedPolygon quarter(
        {{-1.10F, 1.002F}, {-1.32F, 1.012F}, {-1.60F, 1.075F}, {-1.46F, 1.18F}, {-1.12F, 1.305F}},
        0.03F);
    for (const RoundedPolygon* pane : {&front, &rear, &quarter}) {
        inset(mesh, fromSide(*pane, 0.46F), 0.006F, 0.003F, Dark, Glass);
    }
    const RoundedPolygon screen(
        {{-0.70F, 0.985F}, {0.70F, 0.985F}, {0.535F, 1.40F}, {-0.535F, 1.40F}}, 0.06F);
    const Region ahead = fromEnd(screen, 1.0F, 0.18F);
    paint(
        mesh, [&](const SurfacePoint& p) { return ahead(p) - 0.022F; }, GlossBlack);
    inset(mesh, ahead, 0.006F, 0.003F, Dark, Glass);
    const RoundedPolygon back({{-0.62F, 1.05F}, {0.62F, 1.05F}, {0.50F, 1.325F}, {-0.50F, 1.325F}},
                              0.07F);
    const Region behind = fromEnd(back, -1.0F, 0.2F);
    paint(
        mesh, [&](const SurfacePoint& p) { return behind(p) - 0.018F; }, GlossBlack);
    inset(mesh, behind, 0.006F, 0.003F, Dark, Glass);
}

void cutLamps(PartMesh& mesh) {
    const RoundedPolygon lamp({{0.46F, 0.625F},
                               {0.70F, 0.655F},
                               {0.93F, 0.72F},
                               {0.93F, 0.765F},
                               {0.66F, 0.735F},
                               {0.48F, 0.685F}},
                              0.025F);
    inset(mesh, fromEnd(lamp, 1.0F, 0.12F), 0.006F, 0.005F, Dark, LampGlass);
    const RoundedPolygon line({{0.50F, 0.636F},
                               {0.70F, 0.664F},
                               {0.86F, 0.709F},
                               {0.86F, 0.722F},
                               {0.70F, 0.680F},
                               {0.50F, 0.652F}},
                              0.006F);
    paint(mesh, fromEnd(line, 1.0F, 0.14F), HeadLight);
    const RoundedPolygon lens({{0.56F, 0.672F}, {0.68F, 0.692F}, {0.68F, 0.722F}, {0.56F, 0.702F}},
                              0.015F);
    paint(mesh, fromEnd(lens, 1.0F, 0.14F), HeadLight);
    // The air intakes and the slim grille that joins the lamps.
    const RoundedPolygon grille(
        {{-0.5F, 0.635F}, {0.40F, 0.635F}, {0.41F, 0.672F}, {-0.5F, 0.672F}}, 0.012F);
    inset(mesh, fromEnd(grille, 1.0F), 0.006F, 0.010F, Dark, GlossBlack);
    const RoundedPolygon intake({{-0.60F, 0.27F}, {0.60F, 0.27F}, {0.68F, 0.40F}, {-0.68F, 0.40F}},
                                0.035F);
    inset(mesh, fromEnd(intake, 1.0F), 0.012F, 0.03F, Dark, Dark);
    const RoundedPolygon tail({{0.44F, 0.80F}, {0.93F, 0.83F}, {0.93F, 0.90F}, {0.46F, 0.865F}},
                              0.025F);
    inset(mesh, fromEnd(tail, -1.0F, 0.12F), 0.006F, 0.004F, Dark, TailLight);
    const RoundedPolygon bar({{-0.5F, 0.826F}, {0.44F, 0.826F}, {0.44F, 0.842F}, {-0.5F, 0.842F}},
                             0.004F);
    paint(mesh, fromEnd(bar, -1.0F), TailLight);
    const RoundedPolygon apron({{-0.66F, 0.20F}, {0.66F, 0.20F}, {0.58F, 0.36F}, {-0.58F, 0.36F}},
                               0.04F);
    paint(mesh, fromEnd(apron, -1.0F, 0.0F), GlossBlack);
    const RoundedPolygon blinker(
        {{0.60F, 0.842F}, {0.74F, 0.850F}, {0.74F, 0.868F}, {0.60F, 0.860F}}, 0.006F);
    paint(mesh, fromEnd(blinker, -1.0F, 0.12F), Indicator);
}

/// Gaps between doors, bonnet, hatch and fenders; the dark sills.
void cutPanels(PartMesh& mesh) {
    constexpr float kGap = 0.007F;
    const RoundedPolygon frontDoor(
        {{0.80F, 0.26F}, {-0.15F, 0.26F}, {-0.15F, 0.95F}, {0.55F, 0.95F}, {0.82F, 0.90F}}, 0.07F);
    const RoundedPolygon rearDoor({{-0.15F, 0.26F},
                                   {-0.86F, 0.26F},
                                   {-0.90F, 0.50F},
                                   {-1.08F, 0.72F},
                                   {-1.08F, 0.96F},
                                   {-0.15F, 0.95F}},
                                  0.07F);
    outline(mesh, fromSide(frontDoor, 0.55F), kGap, Dark);
    outline(mesh, fromSide(rearDoor, 0.55F), kGap, Dark);
    const RoundedPolygon bonnet({{0.99F, -0.7F},
                                 {0.99F, 0.70F},
                                 {1.6F, 0.735F},
                                 {1.98F, 0.60F},
                                 {2.12F, 0.0F},
                                 {1.98F, -0.60F},
                                 {1.6F, -0.735F}},
                                0.1F);
    outline(
        mesh,
        [&](const SurfacePoint& p) {
            return std::max(bonnet.distance({p.position.x, p.position.y}),
                            0.4F * (0.05F - p.normal.z));
        },
        kGap, Dark);
    const RoundedPolygon hatch({{-0.74F, 0.50F},
                                {0.74F, 0.50F},
                                {0.76F, 0.90F},
                                {0.66F, 1.05F},
                                {0.56F, 1.37F},
                                {-0.56F, 1.37F},
                                {-0.66F, 1.05F},
                                {-0.76F, 0.90F}},
                               0.08F);
    outline(mesh, fromEnd(hatch, -1.0F, 0.12F), kGap, Dark);
    paint(
        mesh, [](const SurfacePoint& p) { return p.position.z - 0.235F; }, GlossBlack);
}

void openArches(PartMesh& mesh) {
    for (const float x : {kFrontAxle, kRearAxle}) {
        const Region arch = [x](const SurfacePoint& p) {
            const float r =
                glm::distance(glm::vec2(p.position.x, p.position.z), {x, kWheelRadius}) - kArch;
            return std::max(r, 0.45F - std::abs(p.position.y));
        };
        paint(
            mesh, [&](const SurfacePoint& p) { return arch(p) - 0.018F; }, GlossBlack);
        removeInside(mesh, arch);
    }
}

PartMesh wheelHouses() {
    PartMesh mesh;
    for (const float x : {kFrontAxle, kRearAxle}) {
        PartMesh ring = lathe({{kArch + 0.002F, 0.0F},
                               {kArch + 0.03F, 0.0F},
                               {kArch + 0.03F, 0.40F},
                               {kArch + 0.002F, 0.38F},
                               {kArch + 0.002F, 0.0F}},
                              {x, 0.44F, kWheelRadius}, {0, 1, 0}, 64, 0.6F, Dark);
        append(ring, cylinder({x, 0.42F, kWheelRadius}, {x, 0.46F, kWheelRadius}, kArch + 0.02F, 48,
                              Dark));
        removeInside(ring, [](const SurfacePoint& p) { return p.position.z - 0.19F; });
        append(mesh, ring);
        append(mesh, mirroredLeftRight(ring));
    }
    WheelSpec wheel;
    wheel.radius = kWheelRadius;
    wheel.width = 0.215F;
    wheel.rimRadius = 0.250F;
    wheel.spokes = 10;
    wheel.tyre = Rubber;
    wheel.rim = Rim;
    wheel.hub = Dark;
    for (const float x : {kFrontAxle, kRearAxle}) {
        append(mesh, roadWheel(wheel, x, 0.865F));
        append(mesh, roadWheel(wheel, x, -0.865F));
    }
    return mesh;
}

PartMesh trim() {
    PartMesh side;
    append(side, ellipsoid({0.56F, 0.985F, 0.985F}, {0.075F, 0.115F, 0.072F}, 40, Paint));
    append(side, ellipsoid({0.525F, 0.985F, 0.985F}, {0.05F, 0.100F, 0.060F}, 32, Chrome));
    append(side, tube({{0.60F, 0.84F, 0.945F}, {0.57F, 0.93F, 0.955F}}, 0.022F, 12, GlossBlack));
    for (const float x : {0.02F, -0.92F}) {
        append(side, roundedBox({x, 0.908F, 0.80F}, {0.19F, 0.05F, 0.028F}, 0.012F, Paint));
    }
    PartMesh mesh = side;
    append(mesh, mirroredLeftRight(side));
    append(mesh, roundedBox({2.195F, 0, 0.475F}, {0.03F, 0.52F, 0.11F}, 0.006F, Plate));
    append(mesh, roundedBox({-2.235F, 0, 0.64F}, {0.03F, 0.52F, 0.11F}, 0.006F, Plate));
    const char* number = "RF 2003";
    const float pitch = 0.0098F;
    const float width = float(dotTextWidth(number)) * pitch;
    append(mesh, dotText(number, {2.2115F, -0.5F * width, 0.442F}, {0, 1, 0}, {0, 0, 1}, pitch,
                         PlateText));
    append(mesh, dotText(number, {-2.2515F, 0.5F * width, 0.607F}, {0, -1, 0}, {0, 0, 1}, pitch,
                         PlateText));
    append(mesh, tube({{-1.62F, 0.0F, 1.40F}, {-1.70F, 0.0F, 1.46F}}, 0.018F, 10, GlossBlack));
    return mesh;
}

PartMesh cabin() {
    PartMesh mesh;
    append(mesh, roundedBox({-0.3F, 0, 0.34F}, {2.4F, 1.4F, 0.06F}, 0.02F, Cabin));
    append(mesh, roundedBox({0.66F, 0, 0.84F}, {0.42F, 1.36F, 0.16F}, 0.06F, Cabin));
    append(mesh, roundedBox({-1.45F, 0, 0.86F}, {0.5F, 1.2F, 0.05F}, 0.02F, Cabin));
    for (const float y : {-0.36F, 0.36F}) {
        for (const float x : {-0.34F, -1.12F}) {
            append(mesh, roundedBox({x + 0.26F, y, 0.52F}, {0.5F, 0.5F, 0.16F}, 0.06F, Cabin));
            append(mesh, roundedBox({x - 0.02F, y, 0.84F}, {0.14F, 0.48F, 0.56F}, 0.06F, Cabin));
            append(mesh, roundedBox({x - 0.06F, y, 1.17F}, {0.09F, 0.26F, 0.15F}, 0.04F, Cabin));
        }
    }
    PartMesh wheel = lathe(
        {{0.185F, -0.012F}, {0.197F, 0.0F}, {0.185F, 0.012F}, {0.173F, 0.0F}, {0.185F, -0.012F}},
        {0.42F, 0.36F, 0.90F}, {-0.9F, 0.0F, 0.42F}, 40, 2.0F, Dark);
    append(mesh, wheel);
    for (const float x : {kFrontAxle, kRearAxle}) {  // nothing where the wheels turn
        removeInside(mesh, [x](const SurfacePoint& p) {
            const float r = glm::distance(glm::vec2(p.position.x, p.position.z), {x, kWheelRadius});
            return std::max(r - kArch - 0.01F, 0.43F - std::abs(p.position.y));
        });
    }
    return mesh;
}

}  // namespace

Vehicle makeCar() {
    PartMesh mesh = carShell();
    cutPanels(mesh);
    openArches(mesh);
    cutWindows(mesh);
    cutLamps(mesh);
    thin(mesh, kThinning);
    append(mesh, wheelHouses());
    append(mesh, trim());
    append(mesh, cabin());
    Vehicle car;
    car.name = "car";
    car.materials = carMaterials();
    VehicleBody body = toBody(std::move(mesh), 0.18F, 1.5F);
    body.pivotSpan = double(kFrontAxle - kRearAxle);
    body.pivotMiddle = 0.5 * double(kFrontAxle + kRearAxle);
    car.bodies.push_back(std::move(body));
    return car;
}

}  // namespace reflet
