// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/TramParts.h"

#include "core/math/Geometry.h"
#include "core/traffic/MeshCutting.h"
#include "core/traffic/MeshPrimitives.h"
#include "core/traffic/VehicleParts.h"
#include "core/traffic/VehicleShell.h"

#include <algorithm>
#include <cmath>

namespace reflet {

using namespace tram;

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

PartMesh tramBogie(float x) {
    PartMesh mesh;
    WheelSpec wheel;
    wheel.radius = kWheelRadius;
    wheel.width = 0.13F;
    wheel.rimRadius = 0.24F;
    wheel.tyre = Steel;
    wheel.rim = Chassis;
    wheel.hub = Steel;
    wheel.segments = 16;  // little of it shows below the skirt
    for (const float dx : {-0.9F, 0.9F}) {
        for (const float side : {-1.0F, 1.0F}) {
            append(mesh, discWheel(wheel, x + dx, side * 0.84F));
            append(mesh, roundedBox({x + dx, side * 0.98F, kWheelRadius + 0.02F},
                                    {0.26F, 0.18F, 0.26F}, 0.05F, Steel));
            append(mesh, cylinder({x + dx, side * 0.98F, 0.42F}, {x + dx, side * 0.98F, 0.58F},
                                  0.085F, 12, Rubber));
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

PartMesh tramInterior(const TramBodyPlan& plan) {
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
    for (const float x : plan.bogies) {
        removeInside(mesh, [x](const SurfacePoint& p) {
            return std::max(std::abs(p.position.x - x) - kBogieHalf - 0.05F, p.position.z - 0.68F);
        });
    }
    return mesh;
}

PartMesh tramBellows(float end, float direction, float drum) {
    PartMesh mesh;
    SectionSpec section{0.30F, 1.05F, 2.62F, 2.98F, 1.20F, 11.0F, 0.26F};
    section.sideStep = section.roofStep = 0.5F;
    const std::vector<glm::vec2> half = curvedSection(section);
    std::vector<glm::vec2> ring = half;
    for (std::size_t i = half.size() - 1; i-- > 1;) {
        ring.emplace_back(-half[i].x, half[i].y);
    }
    const int ribs = 4;
    const int rows = ribs * 2 + 3;
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
                           {0, 0, 1}, 32, 0.6F, Rubber));
    }
    return mesh;
}

PartMesh tramRoof(const TramBodyPlan& plan) {
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

PartMesh tramPantograph() {
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

PartMesh tramCabDetails(const TramBodyPlan& plan, bool tail) {
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

}  // namespace reflet
