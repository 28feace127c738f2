// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/PartMesh.h"
#include "core/traffic/Vehicle.h"

#include <utility>
#include <vector>

namespace reflet {

/// Names of the tram's own: materials and lines.
namespace tram {

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

// Heights of the tram's lines, metres above the rail.
inline constexpr float kBottom = 0.17F, kFloor = 0.36F, kSkirtTop = 0.40F, kSill = 1.02F,
                       kHeader = 2.46F, kRoof = 3.16F;
inline constexpr float kDoorBottom = 0.30F, kDoorTop = 2.40F, kDoorWidth = 1.36F;
inline constexpr float kBellows = 0.22F;  // from a body's end to the joint
inline constexpr float kCabLength = 7.5F, kLongLength = 6.6F, kShortLength = 3.5F;
inline constexpr float kWheelRadius = 0.30F, kBogieHalf = 1.22F;

}  // namespace tram

[[nodiscard]] std::vector<VehicleMaterial> tramMaterials();

/// What stands where along a body's side.
struct TramBodyPlan {
    float length = 6.0F;
    bool cab = false;
    std::vector<float> doors;                    // x of the middles of double doors
    std::vector<float> bogies;                   // x of bogie centres
    std::vector<std::pair<float, float>> panes;  // x from, to
    std::vector<std::pair<float, bool>> seats;   // x, backward
    bool pantograph = false;
    float drumFront = 0.0F, drumRear = 0.0F;  // radii of the drums that it has at its joints
};

/// A powered bogie with its wheels on the rail, its middle at x.
[[nodiscard]] PartMesh tramBogie(float x);
/// Floor, ceiling, seats, poles and the driver's desk; nothing where the bogies are.
[[nodiscard]] PartMesh tramInterior(const TramBodyPlan& plan);
/// Ribbed bellows from a body's end (x = end) to the joint in a direction (+1, -1), and the drum
/// (its radius, or 0) that fills the opening between two bellows in a bend.
[[nodiscard]] PartMesh tramBellows(float end, float direction, float drum);
[[nodiscard]] PartMesh tramRoof(const TramBodyPlan& plan);
/// A single-arm pantograph, raised, its base on the roof at x = 0.
[[nodiscard]] PartMesh tramPantograph();
/// What hangs at the cab: camera arms, and on a front the destination.
[[nodiscard]] PartMesh tramCabDetails(const TramBodyPlan& plan, bool tail);

}  // namespace reflet
