// SPDX-License-Identifier: GPL-3.0-or-later
// The mirror trees of Meyer and Loscos 2003, figure 10.
#include "core/math/Geometry.h"
#include "core/traffic/BuiltInVehicles.h"
#include "core/traffic/MeshPrimitives.h"
#include "core/traffic/VehicleParts.h"

#include <cmath>

namespace reflet {
namespace {

constexpr int kDrops = 64;           // leaves of the crown, as drops of a mirror
constexpr float kGolden = 2.39996F;  // radians: seeds of a sunflower follow each other by it
constexpr glm::vec3 kCrown{0.0F, 0.0F, 5.1F};

/// Directions spread evenly over the sphere.
glm::vec3 spread(int k, int count) {
    const float z = 1.0F - 2.0F * (float(k) + 0.5F) / float(count);
    const float r = std::sqrt(1.0F - z * z);
    return {r * std::cos(kGolden * float(k)), r * std::sin(kGolden * float(k)), z};
}

PartMesh wood() {
    PartMesh mesh = lathe({{0.0F, 0.0F},
                           {0.42F, 0.0F},
                           {0.30F, 0.12F},
                           {0.21F, 0.45F},
                           {0.17F, 1.2F},
                           {0.145F, 2.4F},
                           {0.12F, 3.4F},
                           {0.06F, 5.2F},
                           {0.0F, 5.4F}},
                          {0, 0, 0}, {0, 0, 1}, 32, 1.2F, 0);
    for (int k = 0; k < 9; ++k) {
        const float a = kGolden * float(k);
        const float low = 2.3F + 0.22F * float(k);
        const glm::vec3 out(std::cos(a), std::sin(a), 0.0F);
        const float reach = 1.75F - 0.08F * float(k);
        append(mesh, tube({glm::vec3(0, 0, low), 0.45F * reach * out + glm::vec3(0, 0, low + 0.7F),
                           reach * out + glm::vec3(0, 0, low + 1.15F)},
                          0.055F, 12, 0));
    }
    return mesh;
}

}  // namespace

Vehicle makeMirrorTree() {
    Vehicle vehicle;
    vehicle.name = "mirror-tree";
    VehicleMaterial chrome;
    chrome.name = "chrome";
    chrome.baseColor = glm::vec3(0.93F);
    chrome.metallic = 1.0F;
    vehicle.materials.push_back(chrome);
    PartMesh mesh = wood();
    for (int k = 0; k < kDrops; ++k) {
        const glm::vec3 direction = spread(k, kDrops);
        const float ripple = 0.5F + 0.5F * std::sin(5.3F * float(k));
        const glm::vec3 at =
            kCrown + direction * glm::vec3(2.05F, 2.05F, 1.75F) * (0.86F + 0.16F * ripple);
        const float radius = 0.44F + 0.14F * ripple;
        append(mesh, ellipsoid(at, {radius, radius, 0.86F * radius}, 28, 0));
    }
    VehicleBody body = toBody(std::move(mesh), 2.6F, 7.6F);  // seen from within the crown
    body.pivotSpan = 1.0;
    vehicle.bodies.push_back(std::move(body));
    return vehicle;
}

}  // namespace reflet
