// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/plan/PlanScene.h"

class QPainter;

namespace reflet {

/// Stretches of the routes in the colour of their coverage, with its percentage beside them where
/// there is room, and the façades as dots along the walls. To be painted below the routes.
void paintCoverage(QPainter& painter, const CoverageOverlay& coverage,
                   const PlanTransform& transform);

/// Suggested probes with their number and their gain.
void paintGhosts(QPainter& painter, const PlanScene& scene, const PlanTransform& transform);

}  // namespace reflet
