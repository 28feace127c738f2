// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/input/CameraDrags.h"

#include <algorithm>

namespace reflet {

namespace {

constexpr double kRadiansPerPixel = 0.0055;
constexpr double kFollowFlattest = 0.03, kFollowSteepest = 1.5;  // radians
constexpr double kFollowNearest = 3.0, kFollowFarthest = 300.0;  // metres

}  // namespace

namespace drags {

glm::dvec2 turnFor(const glm::dvec2& movement) {
    return -kRadiansPerPixel * movement;
}

CameraDrag::Move orbit(const glm::dvec3& pivot) {
    return [pivot](const ViewGeometry& start, const glm::dvec2& from, const glm::dvec2& to) {
        const glm::dvec2 angles = turnFor(to - from);
        return orbited(start.camera(), pivot, angles.x, angles.y);
    };
}

CameraDrag::Move pan(const glm::dvec3& grabbed) {
    return [grabbed](const ViewGeometry& start, const glm::dvec2& /*from*/, const glm::dvec2& to) {
        return panned(start, grabbed, to);
    };
}

CameraDrag::Move look() {
    return [](const ViewGeometry& start, const glm::dvec2& from, const glm::dvec2& to) {
        const glm::dvec2 angles = turnFor(to - from);
        return turned(start.camera(), angles.x, angles.y);
    };
}

}  // namespace drags

void FollowDrag::move(const ViewGeometry& /*view*/, const Pointer& pointer) {
    const glm::dvec2 turn = drags::turnFor(pointer.pixel - m_from);
    FollowOffset offset = m_start;
    offset.yaw += turn.x;
    offset.pitch = std::clamp(offset.pitch - turn.y, kFollowFlattest, kFollowSteepest);
    m_apply(offset);
}

FollowOffset zoomedFollow(FollowOffset offset, double factor) {
    offset.distance = std::clamp(offset.distance * factor, kFollowNearest, kFollowFarthest);
    return offset;
}

}  // namespace reflet
