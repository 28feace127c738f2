// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/BuiltInVehicles.h"
#include "core/traffic/MeshPrimitives.h"
#include "core/traffic/VehicleParts.h"

namespace reflet {
namespace {

constexpr float kRadius = 1.0F;
constexpr float kCenterHeight = 1.2F;
constexpr int kSegments = 256;  // facets err by less than a tenth of a millimetre

}  // namespace

Vehicle makeSphere() {
    Vehicle vehicle;
    vehicle.name = "sphere";
    VehicleMaterial chrome;
    chrome.name = "chrome";
    chrome.baseColor = glm::vec3(0.92F);
    chrome.metallic = 1.0F;
    vehicle.materials.push_back(chrome);
    VehicleBody body = toBody(ellipsoid({0, 0, kCenterHeight}, glm::vec3(kRadius), kSegments, 0),
                              kCenterHeight - kRadius, kCenterHeight + kRadius);
    body.pivotSpan = 1.0;
    vehicle.bodies.push_back(std::move(body));
    return vehicle;
}

}  // namespace reflet
