// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plan/PlanScene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr double kLeastScale = 1e-3;  ///< pixels a metre
constexpr double kMostScale = 200.0;
constexpr double kMargin = 0.92;      ///< of the widget that a fitted box takes
constexpr double kReach = 5.0;        ///< pixels around thin things that count as on them
constexpr double kCornerReach = 8.0;  ///< pixels
constexpr double kCameraReach = 9.0;  ///< pixels
constexpr double kCameraTip = 46.0;   ///< pixels from the eye
constexpr double kMiddleRoom = 40.0;  ///< pixels that an edge needs to show its middle

double distance(const QPointF& a, const QPointF& b) {
    return std::hypot(a.x() - b.x(), a.y() - b.y());
}

double distanceToSegment(const QPointF& p, const QPointF& a, const QPointF& b) {
    const QPointF along = b - a;
    const double length = QPointF::dotProduct(along, along);
    const double t =
        length > 0.0 ? std::clamp(QPointF::dotProduct(p - a, along) / length, 0.0, 1.0) : 0.0;
    return distance(p, a + t * along);
}

std::vector<Box> boxesOf(const Vehicle& vehicle) {
    std::vector<Box> boxes;
    for (const VehicleBody& body : vehicle.bodies) {
        Box& box = boxes.emplace_back();
        for (const glm::vec3& vertex : body.vertices)
            box.add(glm::dvec3(vertex));
    }
    return boxes;
}

PlanHit hitHandles(const RouteGlyph& route, const PlanTransform& transform, const QPointF& point) {
    for (std::size_t i = 0; i < route.handles.size(); ++i)
        if (distance(transform.toWidget(route.handles[i]), point) <= kCornerReach)
            return {PlanHit::Kind::Corner, route.id, int(i)};
    for (std::size_t i = 0; i + 1 < route.handles.size(); ++i) {
        const QPointF a = transform.toWidget(route.handles[i]);
        const QPointF b = transform.toWidget(route.handles[i + 1]);
        if (distance(a, b) > kMiddleRoom && distance(0.5 * (a + b), point) <= kCornerReach)
            return {PlanHit::Kind::Middle, route.id, int(i)};
    }
    return {};
}

PlanHit hitProbes(const PlanScene& scene, const PlanTransform& transform, const QPointF& point) {
    PlanHit hit;
    double nearest = probeRadius(transform.scale) + 3.0;
    for (const ProbeGlyph& probe : scene.probes) {
        const double away = distance(transform.toWidget(probe.position), point);
        if (away <= nearest) {
            nearest = away;
            hit = {PlanHit::Kind::Probe, probe.id, 0};
        }
    }
    return hit;
}

PlanHit hitVehicles(const PlanScene& scene, const PlanTransform& transform, const QPointF& point) {
    for (const PlacedReflector& placed : scene.placed()) {
        for (const auto& outline : scene.outlines(placed)) {
            QPolygonF polygon;
            for (const glm::dvec2& corner : outline)
                polygon << transform.toWidget(corner);
            bool on = polygon.containsPoint(point, Qt::OddEvenFill);
            for (qsizetype i = 0; i < polygon.size(); ++i)
                on = on || distanceToSegment(point, polygon[i],
                                             polygon[(i + 1) % polygon.size()]) <= kReach;
            if (on)
                return {PlanHit::Kind::Reflector, placed.id, 0};
        }
    }
    return {};
}

}  // namespace

void PlanTransform::zoom(double factor, const QPointF& point) {
    const glm::dvec2 before = toFrame(point);
    scale = std::clamp(scale * factor, kLeastScale, kMostScale);
    center += before - toFrame(point);
}

void PlanTransform::fit(const Box& box) {
    if (box.empty())
        return;
    const glm::dvec3 middle = box.center();
    center = {middle.x, middle.y};
    const double wide = std::max(box.size().x, 1.0);
    const double high = std::max(box.size().y, 1.0);
    scale = std::clamp(kMargin * std::min(size.width() / wide, size.height() / high), kLeastScale,
                       kMostScale);
}

const ProbeGlyph* PlanScene::probe(const std::string& id) const {
    const auto found = std::find_if(probes.begin(), probes.end(),
                                    [&](const ProbeGlyph& probe) { return probe.id == id; });
    return found == probes.end() ? nullptr : &*found;
}

const RouteGlyph* PlanScene::route(const std::string& id) const {
    const auto found = std::find_if(routes.begin(), routes.end(),
                                    [&](const RouteGlyph& route) { return route.id == id; });
    return found == routes.end() ? nullptr : &*found;
}

std::vector<PlacedReflector> PlanScene::placed() const {
    return traffic ? traffic->at(time) : std::vector<PlacedReflector>{};
}

std::vector<std::vector<glm::dvec2>> PlanScene::outlines(const PlacedReflector& placed) const {
    std::vector<std::pair<double, std::vector<glm::dvec2>>> bodies;
    auto [boxes, isNew] = bodyBoxes.try_emplace(placed.vehicle);
    if (isNew)
        boxes->second = boxesOf(*placed.vehicle);
    for (std::size_t i = 0; i < placed.poses.size() && i < placed.vehicle->bodies.size(); ++i) {
        const VehicleBody& body = placed.vehicle->bodies[i];
        const Box& box = boxes->second[i];
        if (box.empty())
            continue;
        std::vector<glm::dvec2> outline;
        for (const auto& [x, y] : {std::pair{box.max.x, box.min.y},
                                   {box.max.x, box.max.y},
                                   {box.min.x, box.max.y},
                                   {box.min.x, box.min.y}})
            outline.emplace_back(placed.poses[i] * glm::dvec3(x, y, 0.0));
        bodies.emplace_back(body.offset, std::move(outline));
    }
    std::stable_sort(bodies.begin(), bodies.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::vector<glm::dvec2>> result;
    for (auto& body : bodies)
        result.push_back(std::move(body.second));
    return result;
}

QPointF PlanScene::cameraTip(const PlanTransform& transform) const {
    const glm::dvec2 ahead = glm::dvec2(camera->target - camera->position);
    const double length = glm::length(ahead);
    const glm::dvec2 unit = length > 1e-9 ? ahead / length : glm::dvec2(0.0, 1.0);
    return transform.toWidget(camera->position) + kCameraTip * QPointF(unit.x, -unit.y);
}

double probeRadius(double scale) {
    return std::clamp(5.0 + 0.4 * scale, 5.0, 9.0);
}

double ghostRadius(double scale) {
    return std::clamp(4.0 + 0.8 * scale, 4.5, 11.0);
}

PlanHit hitTest(const PlanScene& scene, const PlanTransform& transform, const QPointF& point) {
    for (const RouteGlyph& route : scene.routes)
        if (route.selected)
            if (const PlanHit hit = hitHandles(route, transform, point);
                hit.kind != PlanHit::Kind::None)
                return hit;
    if (const PlanHit hit = hitProbes(scene, transform, point); hit.kind != PlanHit::Kind::None)
        return hit;
    if (scene.coverage)
        for (const GhostProbe& ghost : scene.coverage->ghosts)
            if (distance(transform.toWidget(ghost.position), point) <=
                ghostRadius(transform.scale) + 3.0)
                return {PlanHit::Kind::Ghost, ghost.id, 0};
    if (scene.camera) {
        if (distance(transform.toWidget(scene.camera->position), point) <= kCameraReach)
            return {PlanHit::Kind::CameraEye, {}, 0};
        if (distance(scene.cameraTip(transform), point) <= kCameraReach)
            return {PlanHit::Kind::CameraTarget, {}, 0};
    }
    if (const PlanHit hit = hitVehicles(scene, transform, point); hit.kind != PlanHit::Kind::None)
        return hit;
    for (const RouteGlyph& route : scene.routes)
        for (std::size_t i = 0; i + 1 < route.line.size(); ++i)
            if (distanceToSegment(point, transform.toWidget(route.line[i]),
                                  transform.toWidget(route.line[i + 1])) <= kReach)
                return {PlanHit::Kind::Route, route.id, 0};
    return {};
}

}  // namespace reflet
