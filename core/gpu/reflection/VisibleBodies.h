// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/city/CityView.h"
#include "core/math/Transform.h"

#include <optional>

namespace reflet {

/// The columns of a view that a box may cover, as shares of the width in [0, 1], and the rows, as
/// shares of the height from below; nothing when it lies outside the view. Never too narrow; the
/// whole view when the box reaches behind the eye.
struct ViewColumns {
    float from = 0.0F;
    float to = 1.0F;
    float bottom = 0.0F;
    float top = 1.0F;
};
[[nodiscard]] std::optional<ViewColumns> columnsOf(const Box& box,
                                                   const RigidTransform& project_from_box,
                                                   const CityView& view);

/// The box around a turned box, project frame.
[[nodiscard]] Box placedBounds(const Box& box, const RigidTransform& project_from_box);

}  // namespace reflet
