// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/camera/CameraMoves.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kNarrowestFov = 1.0 / 180.0 * kPi;
constexpr double kWidestFov = 170.0 / 180.0 * kPi;
constexpr double kNearest = 0.2;  // metres: what a wheel may leave between eye and point
constexpr double kFarthest = 20'000.0;
constexpr double kFlattestPan = 0.06;  // sine of the angle to the ground below which it slides off
constexpr double kFarthestPan = 4.0;   // times the distance of the grabbed point
constexpr double kFramingRoom = 1.1;   // air around what is framed
constexpr double kNearestFraming = 1.0;  // metres before the eye

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::dvec3 turnedAboutVertical(const glm::dvec3& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

/// Rodrigues' formula; axis of unit length.
glm::dvec3 turnedAbout(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return c * v + s * glm::cross(axis, v) + (1.0 - c) * glm::dot(axis, v) * axis;
}

/// Where the ray meets the plane through `point` with this normal; the farthest that is allowed
/// when it is beyond or never comes there.
glm::dvec3 onPlane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal,
                   double farthest) {
    const double slope = glm::dot(ray.direction, normal);
    const double t = glm::dot(point - ray.origin, normal) / slope;
    return ray.at(std::isfinite(t) && t > 0.0 ? std::min(t, farthest) : farthest);
}

}  // namespace

Heading headingOf(const Camera& camera) {
    const glm::dvec3 d = camera.target - camera.position;
    const double level = std::hypot(d.x, d.y);
    return {level > 0.0 ? std::atan2(d.y, d.x) : 0.5 * kPi, std::atan2(d.z, level)};
}

glm::dvec3 directionOf(const Heading& heading) {
    const double level = std::cos(heading.pitch);
    return {level * std::cos(heading.yaw), level * std::sin(heading.yaw), std::sin(heading.pitch)};
}

Camera upright(const Camera& camera) {
    Camera result = camera;
    if (!finite(result.position)) {
        result.position = glm::dvec3(0.0);
    }
    const double distance = glm::distance(result.target, result.position);
    if (!std::isfinite(distance) || !(distance > 1e-6)) {
        result.target = result.position + glm::dvec3(0.0, 1.0, 0.0);
    } else {
        Heading heading = headingOf(result);
        if (std::abs(heading.pitch) > kSteepest) {
            heading.pitch = std::clamp(heading.pitch, -kSteepest, kSteepest);
            result.target = result.position + distance * directionOf(heading);
        }
    }
    if (!std::isfinite(result.verticalFov)) {
        result.verticalFov = Camera{}.verticalFov;
    }
    result.verticalFov = std::clamp(result.verticalFov, kNarrowestFov, kWidestFov);
    return result;
}

Camera orbited(const Camera& camera, const glm::dvec3& pivot, double yaw, double pitch) {
    const Camera sound = upright(camera);
    const double before = headingOf(sound).pitch;
    const double tilt = std::clamp(before + pitch, -kSteepest, kSteepest) - before;
    const glm::dvec3 forward = sound.target - sound.position;
    const glm::dvec3 axis = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 0.0, 1.0)));
    const auto turn = [&](const glm::dvec3& v) {
        return turnedAboutVertical(turnedAbout(v, axis, tilt), yaw);
    };
    Camera result = sound;
    result.position = pivot + turn(sound.position - pivot);
    result.target = result.position + turn(forward);
    return result;
}

Camera turned(const Camera& camera, double yaw, double pitch) {
    return orbited(camera, camera.position, yaw, pitch);
}

Camera moved(const Camera& camera, const glm::dvec3& offset) {
    Camera result = camera;
    result.position += offset;
    result.target += offset;
    return result;
}

Camera panned(const ViewGeometry& view, const glm::dvec3& grabbed, const glm::dvec2& pixel) {
    const Ray ray = view.ray(pixel);
    const glm::dvec3 offset = grabbed - view.camera().position;
    const double distance = glm::length(offset);
    const bool flat = std::abs(offset.z) < kFlattestPan * distance ||
                      std::abs(ray.direction.z) < kFlattestPan || ray.direction.z * offset.z < 0.0;
    const glm::dvec3 normal = flat ? view.forward() : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 under = onPlane(ray, grabbed, normal, kFarthestPan * distance);
    return moved(view.camera(), grabbed - under);
}

Camera zoomed(const Camera& camera, const glm::dvec3& towards, double factor) {
    const Camera sound = upright(camera);
    const glm::dvec3 offset = sound.position - towards;
    const double distance = glm::length(offset);
    if (!(distance > 0.0) || !std::isfinite(distance) || !(factor > 0.0)) {
        return sound;
    }
    // Who is nearer or farther than the limits already is not thrown back to them.
    const double wanted =
        std::clamp(distance * factor, std::min(kNearest, distance), std::max(kFarthest, distance));
    Camera result = sound;
    result.position = towards + offset * (wanted / distance);
    // What is looked at stays at the same place of the picture, and comes nearer with the camera.
    const double reach = glm::distance(sound.target, sound.position) * wanted / distance;
    result.target =
        result.position + glm::normalize(sound.target - sound.position) * std::max(reach, kNearest);
    return result;
}

Camera framed(const ViewGeometry& view, const Box& box) {
    if (box.empty() || !finite(box.min) || !finite(box.max)) {
        return view.camera();
    }
    const double up = std::tan(0.5 * view.camera().verticalFov) / kFramingRoom;
    const double across = up * view.width() / view.height();
    const glm::dvec3 center = box.center();
    double distance = kNearestFraming;
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 corner =
            glm::dvec3((k & 1) != 0 ? box.max.x : box.min.x, (k & 2) != 0 ? box.max.y : box.min.y,
                       (k & 4) != 0 ? box.max.z : box.min.z) -
            center;
        const double aside =
            std::max({std::abs(glm::dot(corner, view.right())) / across,
                      std::abs(glm::dot(corner, view.up())) / up, kNearestFraming});
        distance = std::max(distance, aside - glm::dot(corner, view.forward()));
    }
    Camera result = view.camera();
    result.target = center;
    result.position = result.target - view.forward() * distance;
    return result;
}

Camera seenFrom(const Camera& camera, const Heading& heading) {
    Camera result = upright(camera);
    const double distance = glm::distance(result.position, result.target);
    result.position = result.target - distance * directionOf(heading);
    return upright(result);
}

Camera raised(const Camera& camera, double ground, double clearance) {
    const double missing = ground + clearance - camera.position.z;
    return missing > 0.0 ? moved(camera, {0.0, 0.0, missing}) : camera;
}

Camera between(const Camera& from, const Camera& to, double share) {
    const double t = std::clamp(share, 0.0, 1.0);
    if (t <= 0.0 || t >= 1.0) {
        return t <= 0.0 ? from : to;
    }
    const double eased = t * t * (3.0 - 2.0 * t);
    const Heading a = headingOf(from), b = headingOf(to);
    const Heading heading{a.yaw + eased * std::remainder(b.yaw - a.yaw, 2.0 * kPi),
                          a.pitch + eased * (b.pitch - a.pitch)};
    const double reach = (1.0 - eased) * glm::distance(from.position, from.target) +
                         eased * glm::distance(to.position, to.target);
    Camera result;
    result.position = (1.0 - eased) * from.position + eased * to.position;
    result.target = result.position + reach * directionOf(heading);
    result.verticalFov = (1.0 - eased) * from.verticalFov + eased * to.verticalFov;
    return upright(result);
}

Camera following(const PlacedReflector& reflector, const FollowOffset& offset, double verticalFov) {
    const glm::dvec3 ahead = reflector.heading();
    const double yaw = std::atan2(ahead.y, ahead.x) + offset.yaw;
    Camera result;
    result.target = reflector.middle();
    result.position = result.target + offset.distance * directionOf({yaw, offset.pitch});
    result.verticalFov = verticalFov;
    return upright(result);
}

}  // namespace reflet
