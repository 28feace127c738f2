// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFlags>

namespace reflet {

/// Parts of a project that a step has changed. Views follow only what concerns them.
enum class ProjectChange : unsigned {
    Models = 1U << 0U,  ///< the models, how they are read, the frame or the generated ground
    Heightfield = 1U << 1U,
    Bake = 1U << 2U,
    Tuning = 1U << 3U,
    Probes = 1U << 4U,
    Routes = 1U << 5U,
    Reflectors = 1U << 6U,
    Vehicles = 1U << 7U,
    Views = 1U << 8U,
    Light = 1U << 9U,  ///< date, time and sky
    Exposure = 1U << 10U,
    Name = 1U << 11U,
    All = (1U << 12U) - 1U,
};
Q_DECLARE_FLAGS(ProjectChanges, ProjectChange)
Q_DECLARE_OPERATORS_FOR_FLAGS(ProjectChanges)

}  // namespace reflet
