// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

namespace reflet {

/// How a model in local coordinates stands in the project: turned, scaled in plan, moved.
struct ModelPlacement {
    glm::dvec3 offset{0.0};  ///< where the model's zero comes to lie: absolute, as the project's
    double heading = 0.0;    ///< radians, clockwise from grid north to the model's +y
    double scale = 1.0;      ///< metres of the grid per metre of the model, in plan alone

    /// The absolute position of a point of the model.
    [[nodiscard]] glm::dvec3 operator*(const glm::dvec3& inModel) const;
    /// As if `inner` had been applied first.
    [[nodiscard]] ModelPlacement operator*(const ModelPlacement& inner) const;

    friend bool operator==(const ModelPlacement&, const ModelPlacement&) = default;
};

/// The way back.
[[nodiscard]] ModelPlacement inverse(const ModelPlacement& placement);

/// Brings a model that was read in its own frame into `frame`. Sums are made in double: nothing is
/// lost however far the frame lies from the model's zero.
void place(CityModel& model, const ModelPlacement& placement, const ProjectFrame& frame);

}  // namespace reflet
