// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Transform.h"

#include <glm/matrix.hpp>

#include <cmath>

namespace reflet {

RigidTransform RigidTransform::atHeading(const glm::dvec3& position, double heading) {
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    return {glm::dmat3(glm::dvec3(c, s, 0.0), glm::dvec3(-s, c, 0.0), glm::dvec3(0.0, 0.0, 1.0)),
            position};
}

RigidTransform RigidTransform::inverse() const {
    const glm::dmat3 transposed = glm::transpose(rotation);
    return {transposed, -(transposed * translation)};
}

}  // namespace reflet
