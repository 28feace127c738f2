// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/gpu/overlay/CoverageOverlay.h"
#include "core/traffic/Traffic.h"

#include <QPointF>
#include <QPolygonF>
#include <QSizeF>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// Where the plan looks: a point of the frame in the widget's middle, and logical pixels a metre.
struct PlanTransform {
    glm::dvec2 center{0.0};
    double scale = 1.0;
    QSizeF size{1.0, 1.0};

    [[nodiscard]] QPointF toWidget(const glm::dvec2& p) const {
        return {0.5 * size.width() + (p.x - center.x) * scale,
                0.5 * size.height() - (p.y - center.y) * scale};
    }
    [[nodiscard]] QPointF toWidget(const glm::dvec3& p) const { return toWidget(glm::dvec2(p)); }
    [[nodiscard]] glm::dvec2 toFrame(const QPointF& point) const {
        return {center.x + (point.x() - 0.5 * size.width()) / scale,
                center.y - (point.y() - 0.5 * size.height()) / scale};
    }
    /// Keeps what is under `point` there.
    void zoom(double factor, const QPointF& point);
    void fit(const Box& box);
};

/// Something in the plan under a point.
struct PlanHit {
    enum class Kind {
        None,
        Probe,
        Corner,
        Middle,
        Reflector,
        Route,
        CameraEye,
        CameraTarget,
        Ghost,
    };
    Kind kind = Kind::None;
    std::string id;
    int index = 0;  ///< of the corner; of the corner before the middle

    friend bool operator==(const PlanHit&, const PlanHit&) = default;
};

/// What the plan shows over its picture.
struct PlanScene {
    std::vector<ProbeGlyph> probes;
    std::vector<RouteGlyph> routes;
    std::shared_ptr<const Traffic> traffic;
    std::shared_ptr<const CoverageOverlay> coverage;  ///< null: not shown
    double time = 0.0;
    std::string selectedReflector;
    std::optional<Camera> camera;
    std::vector<glm::dvec3> draft;          ///< of the route that is being drawn
    std::optional<glm::dvec3> draftCursor;  ///< its next point
    std::optional<QPointF> keyCursor;       ///< the cross that arrow keys move, widget
    bool placing = false;                   ///< a probe would be put at the cursor
    PlanHit hover;
    PlanHit chosenCorner;

    [[nodiscard]] const ProbeGlyph* probe(const std::string& id) const;
    [[nodiscard]] const RouteGlyph* route(const std::string& id) const;
    /// The outlines of a vehicle's bodies as seen from above, front bodies first, project frame.
    [[nodiscard]] std::vector<std::vector<glm::dvec2>> outlines(
        const PlacedReflector& placed) const;
    [[nodiscard]] std::vector<PlacedReflector> placed() const;
    /// Boxes of the bodies, found once for each vehicle.
    mutable std::map<std::shared_ptr<const Vehicle>, std::vector<Box>> bodyBoxes;
    /// Point on the plan that stands for where the camera looks, at a fixed distance in pixels.
    [[nodiscard]] QPointF cameraTip(const PlanTransform& transform) const;
};

/// The radius of a probe's mark in logical pixels, and of a suggested one's.
[[nodiscard]] double probeRadius(double scale);
[[nodiscard]] double ghostRadius(double scale);

/// What is under a point of the widget; the topmost of what is drawn.
[[nodiscard]] PlanHit hitTest(const PlanScene& scene, const PlanTransform& transform,
                              const QPointF& point);

}  // namespace reflet
