// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <glm/mat3x3.hpp>

namespace reflet {

/// A rotation and a shift: p_in_b = b_from_a * p_in_a. Name instances `b_from_a`, so that
/// neighbours match when multiplied. `rotation` must be orthonormal.
struct RigidTransform {
    glm::dmat3 rotation{1.0};
    glm::dvec3 translation{0.0};

    /// World pose of a thing that stands at `position` with its front (+x) turned `heading`
    /// radians counter-clockwise from grid east.
    [[nodiscard]] static RigidTransform atHeading(const glm::dvec3& position, double heading);

    [[nodiscard]] glm::dvec3 operator*(const glm::dvec3& p) const {
        return rotation * p + translation;
    }
    [[nodiscard]] glm::dvec3 direction(const glm::dvec3& d) const { return rotation * d; }
    [[nodiscard]] RigidTransform operator*(const RigidTransform& inner) const {
        return {rotation * inner.rotation, rotation * inner.translation + translation};
    }
    [[nodiscard]] RigidTransform inverse() const;
};

}  // namespace reflet
