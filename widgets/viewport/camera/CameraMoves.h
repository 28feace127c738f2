// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"
#include "core/rendering/ViewRenderer.h"
#include "core/traffic/Traffic.h"
#include "widgets/viewport/camera/ViewGeometry.h"

#include <glm/vec2.hpp>

// How the camera moves: functions from a camera to a camera. No roll, ever; metres and radians;
// pixels as in ViewGeometry.

namespace reflet {

/// No camera looks steeper than this up or down: at the pole the picture would spin.
inline constexpr double kSteepest = 89.5 / 180.0 * kPi;

/// Which way a camera looks: yaw counter-clockwise from grid east, pitch up from level.
struct Heading {
    double yaw = 0.0;
    double pitch = 0.0;
};
[[nodiscard]] Heading headingOf(const Camera& camera);
/// Unit vector.
[[nodiscard]] glm::dvec3 directionOf(const Heading& heading);

/// The same camera if it is sound; else one that is: finite, looking somewhere, not steeper than
/// kSteepest, with a field of view between 1 and 170 degrees.
[[nodiscard]] Camera upright(const Camera& camera);

/// Turned about a point by angles: yaw about the vertical, then pitch about the camera's level
/// axis. The pivot stays where it is in the picture.
[[nodiscard]] Camera orbited(const Camera& camera, const glm::dvec3& pivot, double yaw,
                             double pitch);
/// Turned on the spot.
[[nodiscard]] Camera turned(const Camera& camera, double yaw, double pitch);
[[nodiscard]] Camera moved(const Camera& camera, const glm::dvec3& offset);

/// Moved level so that `grabbed` comes to lie under `pixel`, on the horizontal plane through it;
/// where that plane is seen too flatly, on the plane through it that faces the camera. A grab at
/// the horizon moves by at most four times the distance.
[[nodiscard]] Camera panned(const ViewGeometry& view, const glm::dvec3& grabbed,
                            const glm::dvec2& pixel);

/// Moved towards a point by a factor on the distance: 0.5 halves it. The point stays where it is
/// in the picture. Never nearer than 0.2 m, never farther than 20 km.
[[nodiscard]] Camera zoomed(const Camera& camera, const glm::dvec3& towards, double factor);

/// The place from which a box fills the picture, without turning the camera.
[[nodiscard]] Camera framed(const ViewGeometry& view, const Box& box);
/// Looking at the same target from the same distance, along a given heading.
[[nodiscard]] Camera seenFrom(const Camera& camera, const Heading& heading);

/// Raised, together with its target, to at least `ground` + `clearance`. NaN ground: unchanged.
[[nodiscard]] Camera raised(const Camera& camera, double ground, double clearance);

/// A way between two cameras: 0 = from, 1 = to, eased at both ends; the heading turns the shorter
/// way round.
[[nodiscard]] Camera between(const Camera& from, const Camera& to, double share);

/// How the camera goes along with a vehicle: seen from it, turning with its heading.
struct FollowOffset {
    double yaw = 2.6;        ///< of the camera about the vehicle, from its driving direction
    double pitch = 0.3;      ///< of the camera above the vehicle, as seen from it
    double distance = 18.0;  ///< metres from its middle
};
[[nodiscard]] Camera following(const PlacedReflector& reflector, const FollowOffset& offset,
                               double verticalFov);

}  // namespace reflet
