// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/math/Transform.h"
#include "core/traffic/Route.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// How a part of a vehicle takes the light. Colours are linear Rec. 709.
struct VehicleMaterial {
    std::string name;
    glm::vec3 baseColor{0.5F};
    float clearCoat = 0.0F;  ///< 0..1: strength of a clear dielectric layer (F0 = 0.04)
    float metallic = 0.0F;   ///< 0..1: chrome and mirrors reflect with their base colour
    float glass = 0.0F;  ///< 0..1: dark glazing that reflects like a dielectric (F0 = 0.04..0.08)
    glm::vec3 emission{0.0F};
};

/// A part of a vehicle with one centre and so one local environment map, at most about 8 m long.
/// Mesh in the body's own frame: x forward, y left, z up, z = 0 on the running surface, x = 0 at
/// the body's middle. Normals are unit, per vertex (smooth), one material per triangle.
struct VehicleBody {
    std::vector<glm::vec3> vertices;
    std::vector<glm::vec3> normals;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint16_t> triangleMaterial;
    glm::vec3 center{0.0F};  ///< of the local map, body frame
    double offset =
        0.0;  ///< metres along the route from the vehicle's middle to the body's (front > 0)
    double pivotSpan =
        0.0;  ///< metres between the two points that follow the route (axles, bogies)
    double pivotMiddle = 0.0;  ///< x of the point half-way between them, body frame
    double swing = 0.0;        ///< radians to both sides by which a limb swings while one walks
    glm::dvec3 hinge{0.0};     ///< about which it does, in the plane y = constant; body frame
};

struct Vehicle {
    std::string name;
    std::vector<VehicleMaterial> materials;
    std::vector<VehicleBody> bodies;
    bool walks = false;  ///< a person: limbs swing with the way walked, and vehicles stop for it

    [[nodiscard]] double length() const;
};

/// Modelled in code, with windows, doors, wheels or bogies and lights: "tram" (five bodies, about
/// 33 m), "bus", "car", and "sphere" (chrome, 2 m); people who walk, "woman", "man" and "child";
/// and the mirrors of Meyer & Loscos 2003, figure 10, "whale" and "mirror-tree". Usage for any
/// other name.
[[nodiscard]] Result<Vehicle> builtInVehicle(std::string_view name);
[[nodiscard]] std::vector<std::string> builtInVehicleNames();

/// Project-frame pose of each body when the vehicle's middle is at distance s of the route: both
/// pivots of a body lie on the route, so that an articulated tram bends along it. Bodies that share
/// a pivot in the straight vehicle share it in every pose (joints); bodies that share both are
/// rigidly coupled. s is clamped so that the vehicle stays on the route; a vehicle longer than the
/// route stands in its middle and overhangs along the end tangents. Where the route climbs, bodies
/// pitch; people don't. `stride`: 0 stands, 1 walks.
[[nodiscard]] std::vector<RigidTransform> bodyPoses(const Vehicle& vehicle, const Route& route,
                                                    double s, double stride = 1.0);

}  // namespace reflet
