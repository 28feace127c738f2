// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/camera/Walker.h"

#include "widgets/viewport/camera/CameraMoves.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kShoulders = 0.3;  // metres around the middle that must be free
constexpr int kShoulderPoints = 8;
constexpr double kWalkingSpeed = 3.0;  // metres a second: a brisk visitor, so that it goes on
constexpr double kRunningSpeed = 9.0;
constexpr double kTurningSpeed = 1.4;   // radians a second
constexpr double kLongestStep = 0.1;    // seconds
constexpr double kStride = 0.1;         // metres that are looked ahead at a time
constexpr double kSteepestSlope = 1.0;  // rise over run
constexpr double kSettling = 0.12;      // seconds in which eyes follow a step up or down
constexpr double kFreeSearch = 60.0;    // metres

bool climbable(const Ground& ground, const glm::dvec2& from, const glm::dvec2& to) {
    const double rise = ground.heightAt(to.x, to.y) - ground.heightAt(from.x, from.y);
    const double run = glm::length(to - from);
    return std::isnan(rise) || rise <= kSteepestSlope * run;
}

glm::dvec2 strideTo(const Ground& ground, const glm::dvec2& from, const glm::dvec2& stride) {
    // Ahead, else along one axis: so one slides along walls instead of sticking to them.
    const bool alongX = std::abs(stride.x) >= std::abs(stride.y);
    const glm::dvec2 x(stride.x, 0.0), y(0.0, stride.y);
    for (const glm::dvec2& part : {stride, alongX ? x : y, alongX ? y : x}) {
        const glm::dvec2 to = from + part;
        if (Walker::isFree(ground, to) && climbable(ground, from, to)) {
            return to;
        }
    }
    return from;
}

Camera placed(const Camera& camera, const glm::dvec3& position) {
    return moved(camera, position - camera.position);
}

}  // namespace

bool Walker::isFree(const Ground& ground, const glm::dvec2& place) {
    if (std::isnan(ground.heightAt(place.x, place.y)) || ground.isSolid(place.x, place.y)) {
        return false;
    }
    for (int k = 0; k < kShoulderPoints; ++k) {
        const double angle = 2.0 * kPi * k / kShoulderPoints;
        if (ground.isSolid(place.x + kShoulders * std::cos(angle),
                           place.y + kShoulders * std::sin(angle))) {
            return false;
        }
    }
    return true;
}

Camera Walker::standing(const Ground& ground, const Camera& camera) {
    const Camera sound = upright(camera);
    glm::dvec2 place(sound.position.x, sound.position.y);
    if (!ground.bounds().empty()) {
        const Box& city = ground.bounds();
        place = glm::clamp(place, glm::dvec2(city.min), glm::dvec2(city.max));
    }
    const glm::dvec2 start = place;
    // Rings around the place, a step wider each time.
    for (double radius = 0.5; !isFree(ground, place) && radius < kFreeSearch; radius += 0.5) {
        const int points = int(2.0 * kPi * radius / 0.5);
        for (int k = 0; k < points && !isFree(ground, place); ++k) {
            const double angle = 2.0 * kPi * k / points;
            place = start + radius * glm::dvec2(std::cos(angle), std::sin(angle));
        }
    }
    if (!isFree(ground, place)) {
        place = start;
    }
    const glm::dvec3 eye(place, ground.heightNear(place.x, place.y) + kEyeHeight);
    // Who looked down from the air looks ahead when he stands.
    Heading heading = headingOf(sound);
    heading.pitch = std::clamp(heading.pitch, -0.2, 0.5);
    Camera result = sound;
    result.position = eye;
    result.target = eye + 10.0 * directionOf(heading);
    return result;
}

Camera Walker::walked(const Ground& ground, const Camera& camera, const WalkInput& input,
                      double seconds) {
    const double time = std::clamp(seconds, 0.0, kLongestStep);
    const Camera facing = turned(camera, input.turn * kTurningSpeed * time, 0.0);
    const double yaw = headingOf(facing).yaw;
    const glm::dvec2 ahead(std::cos(yaw), std::sin(yaw));
    const glm::dvec2 right(ahead.y, -ahead.x);
    glm::dvec2 wish = input.ahead * ahead + input.sideways * right;
    wish /= std::max(1.0, glm::length(wish));
    const double speed = input.fast ? kRunningSpeed : kWalkingSpeed;
    const glm::dvec2 way = wish * speed * time;
    const int strides = std::max(1, int(std::ceil(glm::length(way) / kStride)));
    glm::dvec2 place(facing.position.x, facing.position.y);
    for (int k = 0; k < strides; ++k) {
        place = strideTo(ground, place, way / double(strides));
    }
    const double standing = ground.heightNear(place.x, place.y) + kEyeHeight;
    const double share = 1.0 - std::exp(-time / kSettling);
    const double eye = facing.position.z + share * (standing - facing.position.z);
    return placed(facing, {place, eye});
}

}  // namespace reflet
