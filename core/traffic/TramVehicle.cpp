// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/traffic/BuiltInVehicles.h"
#include "core/traffic/MeshPrimitives.h"
#include "core/traffic/VehicleParts.h"
#include "core/traffic/VehicleShell.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

enum TramMaterial : std::uint16_t {
    Livery,
    Silver,
    GlossBlack,
    Glass,
    Rubber,
    Chassis,
    Steel,
    Fabric,
    Trim,
    PoleYellow,
    HeadLight,
    TailLight,
    Ceiling,
    Display,
    Marker,
};

std::vector<VehicleMaterial> tramMaterials() {
    return {
        {"petrol paint", {0.004F, 0.078F, 0.105F}, 1.0F, 0.0F, 0.0F, {}},
        {"silver paint", {0.56F, 0.58F, 0.59F}, 0.9F, 0.12F, 0.0F, {}},
        {"black mask", {0.006F, 0.0065F, 0.007F}, 1.0F, 0.0F, 0.0F, {}},
        {"window", {0.46F, 0.51F, 0.51F}, 0.0F, 0.22F, 1.0F, {}},
        {"rubber", {0.012F, 0.012F, 0.013F}, 0.0F, 0.0F, 0.0F, {}},
        {"chassis", {0.03F, 0.031F, 0.033F}, 0.0F, 0.0F, 0.0F, {}},
        {"steel", {0.30F, 0.29F, 0.28F}, 0.0F, 0.25F, 0.0F, {}},
        {"seat fabric", {0.02F, 0.10F, 0.16F}, 0.0F, 0.0F, 0.0F, {}},
        {"interior trim", {0.50F, 0.50F, 0.48F}, 0.0F, 0.0F, 0.0F, {}},
        {"yellow pole", {0.80F, 0.48F, 0.02F}, 0.0F, 0.0F, 0.0F, {}},
        {"headlight", {0.9F, 0.9F, 0.9F}, 0.3F, 0.0F, 0.0F, {2.6F, 2.6F, 2.5F}},
        {"tail light", {0.5F, 0.01F, 0.01F}, 0.8F, 0.0F, 0.0F, {0.55F, 0.012F, 0.01F}},
        {"ceiling light", {0.8F, 0.8F, 0.8F}, 0.0F, 0.0F, 0.0F, {0.5F, 0.48F, 0.44F}},
        {"display", {0.02F, 0.01F, 0.0F}, 0.0F, 0.0F, 0.0F, {1.5F, 0.72F, 0.06F}},
        {"marker light", {0.6F, 0.25F, 0.02F}, 0.8F, 0.0F, 0.0F, {0.25F, 0.09F, 0.0F}},
    };
}

// Heights of the tram's lines, metres above the rail.
constexpr float kBottom = 0.17F, kFloor = 0.36F, kSkirtTop = 0.40F, kSill = 1.02F, kHeader = 2.46F,
                kRoof = 3.16F;
constexpr float kDoorBottom = 0.30F, kDoorTop = 2.40F, kDoorWidth = 1.36F;
constexpr float kBellows = 0.22F;  // from a body's end to the joint
constexpr float kCabLength = 7.5F, kLongLength = 6.6F, kShortLength = 3.5F;
constexpr float kWheelRadius = 0.30F, kBogieHalf = 1.22F;

/// What stands where along a body's side.
struct BodyPlan {
    float length = 6.0F;
    bool cab = false;
    std::vector<float> doors;                    // x of the middles of double doors
    std::vector<float> bogies;                   // x of bogie centres
    std::vector<std::pair<float, float>> panes;  // x from, to
    std::vector<std::pair<float, bool>> seats;   // x, backward
    bool pantograph = false;
    float driveFront = 0.0F, driveRear = 0.0F;  // half lengths of the gangway drum beyond the ends
};

Region band(float x0, float z0, float x1, float z1, float radius) {
    return onSides([=](const glm::vec2& p) {
        return roundedRectangle(p, {x0, z0}, {x1, z1}, radius);
    });
}

Shell tramShell(const BodyPlan& plan) {
    ShellSpec spec;
    spec.halfSection = curvedSection({kBottom, 1.05F, 2.72F, kRoof, 1.325F, 11.0F, 0.34F});
    const float half = 0.5F * plan.length;
    spec.rear.base = -half + 0.05F;
    spec.front.base = half - 0.05F;
    spec.step = 0.11F;
    if (plan.cab) {
        // Middle line of the nose: bumper foremost, windscreen raked, a soft brow into the roof.
        spec.front.reach = Curve{{0.17F, 1.30F}, {0.35F, 1.46F}, {0.62F, 1.55F}, {0.95F, 1.53F},
                                 {1.4F, 1.38F},  {2.0F, 1.10F},  {2.6F, 0.78F},  {2.9F, 0.58F},
                                 {3.06F, 0.42F}, {3.12F, 0.28F}, {kRoof, 0.05F}};
        spec.front.base = half - 1.55F;
        spec.front.roundness = 2.7F;
        spec.front.rows = 34;
    }
    return vehicleShell(spec, Livery);
}

void paintLivery(Shell& shell, const BodyPlan& plan) {
    const float half = 0.5F * plan.length;
    paint(
        shell.mesh, [](const SurfacePoint& p) { return 2.60F - p.position.z; }, Silver);
    paint(
        shell.mesh, [](const SurfacePoint& p) { return p.position.z - kSkirtTop; }, Chassis);
    const float end = plan.cab ? shell.frontTip - 2.28F : half - 0.06F;
    paint(shell.mesh, band(-half + 0.06F, kSill, end, kHeader, 0.08F), GlossBlack);
    // A thin silver line below the windows gathers the five bodies into one vehicle.
    paint(shell.mesh, onSides([](const glm::vec2& p) { return std::abs(p.y - 0.90F) - 0.022F; }),
          Silver);
    outline(
        shell.mesh, [](const SurfacePoint& p) { return p.position.z - kSkirtTop; }, 0.012F, Rubber);
}

void cutPanes(Shell& shell, const BodyPlan& plan) {
    for (const auto& [from, to] : plan.panes) {
        inset(shell.mesh, band(from, kSill + 0.07F, to, kHeader - 0.08F, 0.09F), 0.008F, 0.006F,
              Rubber, Glass);
    }
    for (const float x : plan.doors) {
        const float h = 0.5F * kDoorWidth;
        inset(shell.mesh, band(x - h, kDoorBottom, x + h, kDoorTop, 0.07F), 0.014F, 0.016F, Rubber,
              Silver);
        outline(shell.mesh, onSides([=](const glm::vec2& p) {
                    return std::max(std::abs(p.x - x) - 0.009F,
                                    std::abs(p.y - 0.5F * (kDoorBottom + kDoorTop)) -
                                        0.5F * (kDoorTop - kDoorBottom) + 0.02F);
                }),
                0.012F, Rubber);
        for (const float side : {-1.0F, 1.0F}) {
            const float a = x + side * 0.05F;
            const float b = x + side * (h - 0.07F);
            inset(
                shell.mesh,
                band(std::min(a, b), kDoorBottom + 0.22F, std::max(a, b), kDoorTop - 0.10F, 0.10F),
                0.010F, 0.004F, Rubber, Glass);
        }
        paint(shell.mesh, onSides([=](const glm::vec2& p) {
                  return glm::distance(p, {x + h + 0.14F, 1.0F}) - 0.03F;
              }),
              Marker);
    }
}

/// Windscreen, cab window, lamps. t: length along the shell from the middle line.
void cutNose(Shell& shell, bool tail) {
    const float tip = shell.frontTip;
    const auto front = [tip](const auto& shape) {
        return onSides(
            [tip, shape](const glm::vec2& p) { return shape(glm::vec2(tip - p.x, p.y)); });
    };
    const RoundedPolygon mask({{-1.9F, 1.16F},
                               {1.9F, 1.16F},
                               {2.6F, 1.02F},
                               {2.6F, 2.46F},
                               {1.7F, 2.74F},
                               {1.05F, 2.90F},
                               {-1.05F, 2.90F}},
                              0.12F);
    paint(shell.mesh, front([&](const glm::vec2& p) { return mask.distance(p); }), GlossBlack);
    const RoundedPolygon screen({{-1.16F, 1.24F},
                                 {1.16F, 1.24F},
                                 {1.30F, 1.5F},
                                 {1.14F, 2.80F},
                                 {-1.14F, 2.80F},
                                 {-1.30F, 1.5F}},
                                0.14F);
    inset(shell.mesh, front([&](const glm::vec2& p) { return screen.distance(p); }), 0.008F, 0.004F,
          Rubber, Glass);
    const RoundedPolygon cab({{1.46F, 1.25F}, {2.30F, 1.10F}, {2.30F, 2.38F}, {1.42F, 2.56F}},
                             0.09F);
    inset(shell.mesh, front([&](const glm::vec2& p) { return cab.distance(p); }), 0.008F, 0.005F,
          Rubber, Glass);
    // Lamps: a dark housing that follows the nose, a slim light in it, an indicator at its outer
    // end.
    const RoundedPolygon housing({{0.46F, 0.74F}, {1.40F, 0.86F}, {1.42F, 0.98F}, {0.50F, 0.86F}},
                                 0.045F);
    inset(shell.mesh, front([&](const glm::vec2& p) { return housing.distance(p); }), 0.008F,
          0.008F, Rubber, GlossBlack);
    const RoundedPolygon lamp({{0.52F, 0.765F}, {1.06F, 0.835F}, {1.08F, 0.905F}, {0.54F, 0.835F}},
                              0.03F);
    paint(shell.mesh, front([&](const glm::vec2& p) { return lamp.distance(p); }),
          std::uint16_t(tail ? TailLight : HeadLight));
    const RoundedPolygon indicator(
        {{1.12F, 0.85F}, {1.34F, 0.88F}, {1.35F, 0.945F}, {1.13F, 0.915F}}, 0.025F);
    paint(shell.mesh, front([&](const glm::vec2& p) { return indicator.distance(p); }), Marker);
    // The panel over the coupler.
    outline(shell.mesh, front([](const glm::vec2& p) {
                return roundedRectangle(p, {-0.42F, 0.24F}, {0.42F, 0.66F}, 0.08F);
            }),
            0.010F, Rubber);
}

PartMesh bogie(float x) {
    PartMesh mesh;
    WheelSpec wheel;
    wheel.radius = kWheelRadius;
    wheel.width = 0.13F;
    wheel.rimRadius = 0.24F;
    wheel.tyre = Steel;
    wheel.rim = Chassis;
    wheel.hub = Steel;
    for (const float dx : {-0.9F, 0.9F}) {
        for (const float side : {-1.0F, 1.0F}) {
            append(mesh, discWheel(wheel, x + dx, side * 0.84F));
            append(mesh, roundedBox({x + dx, side * 0.98F, kWheelRadius + 0.02F},
                                    {0.26F, 0.18F, 0.26F}, 0.05F, Steel));
            append(mesh, cylinder({x + dx, side * 0.98F, 0.42F}, {x + dx, side * 0.98F, 0.58F},
                                  0.085F, 20, Rubber));
        }
    }
    for (const float side : {-1.0F, 1.0F}) {
        append(mesh, roundedBox({x, side * 1.0F, 0.40F}, {1.5F, 0.12F, 0.16F}, 0.04F, Chassis));
        append(mesh, roundedBox({x, side * 1.04F, 0.30F}, {0.7F, 0.14F, 0.20F}, 0.05F, Chassis));
        append(mesh, cylinder({x - 0.38F, side * 1.08F, 0.52F}, {x + 0.38F, side * 1.08F, 0.46F},
                              0.045F, 14, Steel));
        append(mesh, roundedBox({x, side * 0.80F, 0.09F}, {0.72F, 0.10F, 0.07F}, 0.02F,
                                Steel));  // track brake
    }
    append(mesh, roundedBox({x, 0, 0.42F}, {2.0F * kBogieHalf + 0.1F, 1.3F, 0.42F}, 0.02F, Rubber));
    append(mesh, roundedBox({x, 0, 0.70F}, {2.0F * kBogieHalf + 0.1F, 2.5F, 0.05F}, 0.02F, Rubber));
    return mesh;
}

void openBogies(Shell& shell, const BodyPlan& plan) {
    for (const float x : plan.bogies) {
        const RoundedPolygon opening({{x - kBogieHalf, -0.5F},
                                      {x + kBogieHalf, -0.5F},
                                      {x + kBogieHalf - 0.1F, 0.62F},
                                      {x - kBogieHalf + 0.1F, 0.62F}},
                                     0.16F);
        const Region region = [&](const SurfacePoint& p) {
            return opening.distance({p.position.x, p.position.z});
        };
        outline(
            shell.mesh, [&](const SurfacePoint& p) { return region(p) - 0.02F; }, 0.04F, Chassis);
        removeInside(shell.mesh, region);
    }
}

PartMesh interior(const BodyPlan& plan) {
    PartMesh mesh;
    const float half = 0.5F * plan.length;
    const float front = plan.cab ? half - 2.5F : half;
    append(mesh, roundedBox({0.5F * (front - half), 0, kFloor - 0.02F},
                            {front + half - 0.3F, 2.46F, 0.05F}, 0.01F, Chassis));
    append(mesh, roundedBox({0.5F * (front - half), 0, 2.70F}, {front + half - 0.2F, 2.2F, 0.04F},
                            0.01F, Trim));
    for (const float side : {-0.62F, 0.62F}) {
        append(mesh, roundedBox({0.5F * (front - half), side, 2.66F},
                                {front + half - 0.8F, 0.14F, 0.05F}, 0.015F, Ceiling));
    }
    for (const auto& [x, backward] : plan.seats) {
        for (const float side : {-0.82F, 0.82F}) {
            const float base = plan.bogies.empty() ? kFloor : kFloor + 0.12F;
            append(mesh, seatPair(x, side, base, backward, Fabric, Trim));
        }
    }
    for (const float x : plan.doors) {
        for (const float dx : {-0.62F, 0.62F}) {
            for (const float side : {-0.78F, 0.78F}) {
                append(mesh, pole(x + dx, side, kFloor, 2.68F, PoleYellow));
            }
        }
    }
    if (plan.cab) {
        const float wall = half - 2.55F;
        append(mesh,
               roundedBox({wall, 0, 1.52F}, {0.05F, 2.3F, 2.3F}, 0.02F, Chassis));  // partition
        append(mesh,
               roundedBox({half - 0.95F, 0, 1.02F}, {0.75F, 1.9F, 0.30F}, 0.12F, Rubber));  // desk
        append(mesh, roundedBox({half - 1.75F, 0, 0.85F}, {0.5F, 0.5F, 0.12F}, 0.05F, Chassis));
        append(mesh, roundedBox({half - 1.98F, 0, 1.25F}, {0.12F, 0.5F, 0.8F}, 0.05F, Chassis));
        append(mesh, roundedBox({half - 1.75F, 0, 0.60F}, {1.6F, 1.9F, 0.06F}, 0.02F, Chassis));
    }
    return mesh;
}

/// Ribbed bellows from the body's end to the joint, and the drum that fills the opening of a bend.
PartMesh bellows(float end, float direction, float drum) {
    PartMesh mesh;
    SectionSpec section{0.30F, 1.05F, 2.62F, 2.98F, 1.20F, 11.0F, 0.26F};
    const std::vector<glm::vec2> half = curvedSection(section);
    std::vector<glm::vec2> ring = half;
    for (std::size_t i = half.size() - 1; i-- > 1;) {
        ring.emplace_back(-half[i].x, half[i].y);
    }
    const int ribs = 4;
    const int rows = ribs * 4 + 2;
    const glm::vec2 middle(0.0F, 1.6F);
    PartMesh fold = gridSurface(rows, int(ring.size()), true, Rubber, 0.8F, [&](int i, int j) {
        const int k = std::clamp(i - 1, 0, rows - 3);
        const float t = float(k) / float(rows - 3);
        const float depth = 0.035F * (0.5F - 0.5F * std::cos(2.0F * float(kPi) * float(ribs) * t));
        const bool closed = i == 0 || i == rows - 1;
        const glm::vec2 p =
            closed ? middle : middle + (ring[std::size_t(j)] - middle) * (1.0F - depth);
        const float x = end + direction * (-0.06F + t * (kBellows + 0.06F - 0.012F));
        return GridPoint{{x, p.x, p.y}, {}};
    });
    faceOutwards(fold);
    append(mesh, fold);
    if (drum > 0.0F) {
        const float x = end + direction * kBellows;
        append(mesh, lathe({{0, 0.34F}, {drum, 0.34F}, {drum, 2.8F}, {0, 2.8F}}, {x, 0, 0},
                           {0, 0, 1}, 48, 0.6F, Rubber));
    }
    return mesh;
}

PartMesh roofEquipment(const BodyPlan& plan) {
    PartMesh mesh;
    const float half = 0.5F * plan.length;
    const float from = -half + 0.35F;
    const float to = plan.cab ? half - 2.2F : half - 0.35F;
    const float gap = plan.pantograph ? 1.1F : 0.0F;
    const auto shroud = [&](float a, float b) {
        append(mesh, roundedBox({0.5F * (a + b), 0, 3.27F}, {b - a, 1.94F, 0.46F}, 0.13F, Silver));
        for (float x = a + 0.35F; x + 0.5F < b; x += 0.75F) {  // grilles of the cooling units
            append(mesh, roundedBox({x + 0.25F, 0, 3.30F}, {0.5F, 1.952F, 0.11F}, 0.004F, Chassis));
        }
    };
    if (gap > 0.0F) {
        shroud(from, -gap);
        shroud(gap, to);
    } else {
        shroud(from, to);
    }
    return mesh;
}

/// A single-arm pantograph, raised, its base on the roof at x = 0.
PartMesh pantograph() {
    PartMesh mesh;
    const glm::vec3 knee(-0.95F, 0, 3.92F);
    const glm::vec3 head(0.25F, 0, 4.58F);
    for (const float y : {-0.42F, 0.42F}) {
        append(mesh, roundedBox({0, y, 3.30F}, {1.5F, 0.07F, 0.07F}, 0.015F, Steel));
        for (const float x : {-0.6F, 0.6F}) {
            append(mesh, lathe({{0, 0},
                                {0.06F, 0},
                                {0.06F, 0.03F},
                                {0.035F, 0.05F},
                                {0.06F, 0.08F},
                                {0.035F, 0.11F},
                                {0, 0.12F}},
                               {x, y, 3.16F}, {0, 0, 1}, 20, 0.6F, Fabric));
        }
    }
    for (const float x : {-0.6F, 0.55F}) {
        append(mesh, roundedBox({x, 0, 3.32F}, {0.08F, 0.9F, 0.07F}, 0.015F, Steel));
    }
    append(mesh, tube({{0.55F, 0.0F, 3.36F}, knee}, 0.045F, 14, Steel));
    append(mesh,
           tube({{0.40F, 0.16F, 3.34F}, knee + glm::vec3(0.1F, 0.05F, -0.06F)}, 0.018F, 10, Steel));
    append(mesh, cylinder(knee + glm::vec3(0, -0.14F, 0), knee + glm::vec3(0, 0.14F, 0), 0.04F, 16,
                          Steel));
    for (const float y : {-1.0F, 1.0F}) {
        append(mesh,
               tube({knee + glm::vec3(0, 0.12F * y, 0), head + glm::vec3(0, 0.42F * y, -0.06F)},
                    0.022F, 12, Steel));
    }
    append(mesh, tube({head + glm::vec3(0, -0.46F, -0.06F), head + glm::vec3(0, 0.46F, -0.06F)},
                      0.02F, 10, Steel));
    for (const float x : {-0.16F, 0.16F}) {
        append(mesh, tube({head + glm::vec3(x, -0.82F, -0.16F), head + glm::vec3(x, -0.6F, -0.02F),
                           head + glm::vec3(x, 0.6F, -0.02F), head + glm::vec3(x, 0.82F, -0.16F)},
                          0.018F, 10, Steel));
        append(mesh,
               roundedBox(head + glm::vec3(x, 0, 0.005F), {0.05F, 1.1F, 0.03F}, 0.008F, Chassis));
    }
    return mesh;
}

/// What hangs at the cab: mirror cameras, wipers, the destination.
PartMesh cabDetails(const BodyPlan& plan, bool tail) {
    PartMesh mesh;
    const float half = 0.5F * plan.length;
    for (const float side : {-1.0F, 1.0F}) {
        append(mesh, roundedBox({half - 1.25F, side * 1.22F, 2.62F}, {0.16F, 0.34F, 0.05F}, 0.02F,
                                GlossBlack));
        append(mesh, roundedBox({half - 1.22F, side * 1.36F, 2.56F}, {0.24F, 0.09F, 0.13F}, 0.04F,
                                GlossBlack));
    }
    if (tail) {
        return mesh;
    }
    const char* text = "T1 PLACE";
    const float pitch = 0.021F;
    const float width = float(dotTextWidth(text)) * pitch;
    append(mesh, roundedBox({half - 1.12F, 0, 2.58F}, {0.06F, 1.5F, 0.26F}, 0.02F, Rubber));
    // Read from the front: the reader's right is the vehicle's left.
    append(mesh, dotText(text, {half - 1.085F, -0.5F * width, 2.51F}, {0, 1, 0}, {0, 0, 1}, pitch,
                         Display));
    return mesh;
}

VehicleBody tramBody(const BodyPlan& plan, bool tail) {
    Shell shell = tramShell(plan);
    paintLivery(shell, plan);
    if (plan.cab) {
        cutNose(shell, tail);
    }
    cutPanes(shell, plan);
    openBogies(shell, plan);
    PartMesh mesh = std::move(shell.mesh);
    const float half = 0.5F * plan.length;
    append(mesh, bellows(-half, -1.0F, plan.driveRear));
    if (plan.cab) {
        append(mesh, cabDetails(plan, tail));
    } else {
        append(mesh, bellows(half, 1.0F, plan.driveFront));
    }
    for (const float x : plan.bogies) {
        append(mesh, bogie(x));
    }
    append(mesh, interior(plan));
    append(mesh, roofEquipment(plan));
    if (plan.pantograph) {
        append(mesh, pantograph());
    }
    return toBody(tail ? turnedAround(std::move(mesh)) : std::move(mesh), kBottom, kRoof + 0.3F);
}

BodyPlan cabPlan() {
    BodyPlan plan;
    plan.length = kCabLength;
    plan.cab = true;
    plan.doors = {-2.55F};
    plan.bogies = {-0.15F};
    plan.panes = {{-3.60F, -3.34F}, {-1.72F, -0.32F}, {-0.24F, 1.16F}};
    plan.seats = {{-1.25F, false}, {-0.15F, true}, {0.15F, false}, {1.05F, true}};
    return plan;
}

BodyPlan longPlan() {
    BodyPlan plan;
    plan.length = kLongLength;
    plan.doors = {-1.75F, 1.75F};
    plan.panes = {{-3.26F, -2.56F}, {-0.90F, 0.90F}, {2.56F, 3.26F}};
    plan.seats = {{-0.62F, false}, {0.62F, true}, {-3.0F, false}, {3.0F, true}};
    return plan;
}

BodyPlan shortPlan() {
    BodyPlan plan;
    plan.length = kShortLength;
    plan.bogies = {0.0F};
    plan.panes = {{-1.60F, -0.04F}, {0.04F, 1.60F}};
    plan.seats = {{-1.25F, false}, {-0.12F, true}, {0.12F, false}, {1.25F, true}};
    plan.pantograph = true;
    plan.driveFront = plan.driveRear = 0.82F;
    return plan;
}

}  // namespace

Vehicle makeTram() {
    Vehicle tram;
    tram.name = "tram";
    tram.materials = tramMaterials();
    BodyPlan frontLong = longPlan();
    frontLong.driveFront = 0.82F;
    BodyPlan rearLong = longPlan();
    rearLong.driveRear = 0.82F;
    const BodyPlan plans[] = {cabPlan(), frontLong, shortPlan(), rearLong, cabPlan()};
    tram.bodies.resize(std::size(plans));
    parallelFor(0, std::size(plans), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            tram.bodies[i] = tramBody(plans[i], i + 1 == std::size(plans));
        }
    });
    // Joints lie kBellows beyond the ends. The inner bodies hang between their joints; a cab turns
    // about its inner joint and its bogie.
    const double shortSpan = double(kShortLength + 2.0F * kBellows);
    const double longSpan = double(kLongLength + 2.0F * kBellows);
    const double cabReach = 0.5 * double(kCabLength) + double(kBellows);  // middle to inner joint
    const double bogieAt = double(cabPlan().bogies.front()) + 1.0;        // of its leading wheels
    const double offsets[] = {0.5 * shortSpan + longSpan + cabReach, 0.5 * (shortSpan + longSpan),
                              0.0, -0.5 * (shortSpan + longSpan),
                              -(0.5 * shortSpan + longSpan + cabReach)};
    for (std::size_t i = 0; i < 5; ++i) {
        VehicleBody& body = tram.bodies[i];
        body.offset = offsets[i];
        body.pivotSpan = i == 2 ? shortSpan : longSpan;
        if (i == 0 || i == 4) {
            const double sign = i == 0 ? 1.0 : -1.0;
            body.pivotSpan = cabReach + bogieAt;
            body.pivotMiddle = sign * 0.5 * (bogieAt - cabReach);
        }
    }
    return tram;
}

}  // namespace reflet
