// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/traffic/BuiltInVehicles.h"
#include "core/traffic/MeshThinning.h"
#include "core/traffic/TramParts.h"
#include "core/traffic/VehicleParts.h"
#include "core/traffic/VehicleShell.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {

using namespace tram;

namespace {

Region band(float x0, float z0, float x1, float z1, float radius) {
    return onSides([=](const glm::vec2& p) {
        return roundedRectangle(p, {x0, z0}, {x1, z1}, radius);
    });
}

Shell tramShell(const TramBodyPlan& plan) {
    ShellSpec spec;
    spec.halfSection = curvedSection({kBottom, 1.05F, 2.72F, kRoof, 1.325F, 11.0F, 0.34F});
    const float half = 0.5F * plan.length;
    spec.rear.base = -half + 0.05F;
    spec.front.base = half - 0.05F;
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

void paintLivery(Shell& shell, const TramBodyPlan& plan) {
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

void cutPanes(Shell& shell, const TramBodyPlan& plan) {
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

/// Windscreen, cab window, head lamps. t: length along the shell from the middle line.
void cutNose(Shell& shell) {
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
    paint(shell.mesh, front([&](const glm::vec2& p) { return lamp.distance(p); }), HeadLight);
    const RoundedPolygon indicator(
        {{1.12F, 0.85F}, {1.34F, 0.88F}, {1.35F, 0.945F}, {1.13F, 0.915F}}, 0.025F);
    paint(shell.mesh, front([&](const glm::vec2& p) { return indicator.distance(p); }), Marker);
    // The panel over the coupler.
    outline(shell.mesh, front([](const glm::vec2& p) {
                return roundedRectangle(p, {-0.42F, 0.24F}, {0.42F, 0.66F}, 0.08F);
            }),
            0.010F, Rubber);
}

void openBogies(Shell& shell, const TramBodyPlan& plan) {
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

/// The skin of a body with all that is cut into it; the slow part.
PartMesh tramSkin(const TramBodyPlan& plan) {
    Shell shell = tramShell(plan);
    paintLivery(shell, plan);
    if (plan.cab) {
        cutNose(shell);
    }
    cutPanes(shell, plan);
    openBogies(shell, plan);
    thin(shell.mesh, kThinning);
    return std::move(shell.mesh);
}

VehicleBody tramBody(const TramBodyPlan& plan, PartMesh mesh, bool tail) {
    if (tail) {
        std::replace(mesh.material.begin(), mesh.material.end(), std::uint16_t(HeadLight),
                     std::uint16_t(TailLight));
    }
    const float half = 0.5F * plan.length;
    append(mesh, tramBellows(-half, -1.0F, plan.drumRear));
    if (plan.cab) {
        append(mesh, tramCabDetails(plan, tail));
    } else {
        append(mesh, tramBellows(half, 1.0F, plan.drumFront));
    }
    for (const float x : plan.bogies) {
        append(mesh, tramBogie(x));
    }
    append(mesh, tramInterior(plan));
    append(mesh, tramRoof(plan));
    if (plan.pantograph) {
        append(mesh, tramPantograph());
    }
    return toBody(tail ? turnedAround(std::move(mesh)) : std::move(mesh), kBottom, kRoof + 0.3F);
}

TramBodyPlan cabPlan() {
    TramBodyPlan plan;
    plan.length = kCabLength;
    plan.cab = true;
    plan.doors = {-2.55F};
    plan.bogies = {-0.15F};
    plan.panes = {{-3.60F, -3.34F}, {-1.72F, -0.32F}, {-0.24F, 1.16F}};
    plan.seats = {{-1.25F, false}, {-0.15F, true}, {0.15F, false}, {1.05F, true}};
    return plan;
}

TramBodyPlan longPlan() {
    TramBodyPlan plan;
    plan.length = kLongLength;
    plan.doors = {-1.75F, 1.75F};
    plan.panes = {{-3.26F, -2.56F}, {-0.90F, 0.90F}, {2.56F, 3.26F}};
    plan.seats = {{-0.62F, false}, {0.62F, true}, {-3.0F, false}, {3.0F, true}};
    return plan;
}

TramBodyPlan shortPlan() {
    TramBodyPlan plan;
    plan.length = kShortLength;
    plan.bogies = {0.0F};
    plan.panes = {{-1.60F, -0.04F}, {0.04F, 1.60F}};
    plan.seats = {{-1.25F, false}, {-0.12F, true}, {0.12F, false}, {1.25F, true}};
    plan.pantograph = true;
    plan.drumFront = plan.drumRear = 0.82F;
    return plan;
}

}  // namespace

Vehicle makeTram() {
    Vehicle tram;
    tram.name = "tram";
    tram.materials = tramMaterials();
    TramBodyPlan frontLong = longPlan();
    frontLong.drumFront = 0.82F;
    TramBodyPlan rearLong = longPlan();
    rearLong.drumRear = 0.82F;
    const TramBodyPlan plans[] = {cabPlan(), frontLong, shortPlan(), rearLong, cabPlan()};
    // Both cabs have the same skin, and both long bodies.
    PartMesh skins[3];
    parallelFor(0, std::size(skins), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            skins[i] = tramSkin(plans[i]);
        }
    });
    tram.bodies.resize(std::size(plans));
    parallelFor(0, std::size(plans), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::size_t skin = std::min(i, std::size(plans) - 1 - i);
            tram.bodies[i] = tramBody(plans[i], skins[skin], i + 1 == std::size(plans));
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
