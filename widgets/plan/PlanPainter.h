// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/plan/PlanPicture.h"
#include "widgets/plan/PlanScene.h"

#include <QPalette>
#include <QString>

class QPainter;

namespace reflet {

/// The picture's part that the widget shows, from the level that fits the scale.
void paintGround(QPainter& painter, const PlanPicture& picture, const PlanTransform& transform,
                 const QPalette& palette);

/// Text that is legible on any ground; `at`: where its base line begins.
void paintHaloText(QPainter& painter, const QPointF& at, const QString& text);

/// Routes, vehicles, probes, camera, and what a tool is about to make.
void paintScene(QPainter& painter, const PlanScene& scene, const PlanTransform& transform);

/// Scale bar, north arrow and the line of text at the bottom left (may be empty).
void paintFrame(QPainter& painter, const PlanTransform& transform, const QString& text,
                const QPalette& palette);

}  // namespace reflet
