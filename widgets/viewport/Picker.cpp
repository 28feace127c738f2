// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/Picker.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kBallRadius = 0.35;  // metres: a probe's ball as it is drawn
constexpr double kPreviewRadius = 1.0;
constexpr double kTie =
    2.0;  // pixels: of what is as near to the mouse the nearest to the eye counts

bool better(const Picked& a, const std::optional<Picked>& b) {
    if (!b) {
        return true;
    }
    const double difference = a.pixels - b->pixels;
    return std::abs(difference) > kTie ? difference < 0.0 : a.depth < b->depth;
}

/// Distance of a pixel from a segment in the picture, and how far along it, 0..1.
std::pair<double, double> fromSegment(const glm::dvec2& pixel, const glm::dvec2& a,
                                      const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double squared = glm::dot(along, along);
    const double share =
        squared > 0.0 ? std::clamp(glm::dot(pixel - a, along) / squared, 0.0, 1.0) : 0.0;
    return {glm::distance(pixel, a + share * along), share};
}

void offerProbe(const ViewGeometry& view, const ProbeGlyph& probe, const glm::dvec2& pixel,
                double reach, std::optional<Picked>& best) {
    const ProjectedPoint at = view.project(probe.position);
    if (!(at.depth > 0.0)) {
        return;
    }
    const double radius =
        (probe.preview ? kPreviewRadius : kBallRadius) / view.metresPerPixel(at.depth);
    const double outside = std::max(0.0, glm::distance(at.pixel, pixel) - radius);
    if (outside <= reach) {
        const Picked found{Picked::Kind::Probe, probe.id, 0, probe.position, outside, at.depth};
        if (better(found, best)) {
            best = found;
        }
    }
}

void offerHandles(const ViewGeometry& view, const RouteGlyph& route, const glm::dvec2& pixel,
                  double reach, std::optional<Picked>& best) {
    for (std::size_t k = 0; route.selected && k < route.handles.size(); ++k) {
        const ProjectedPoint at = view.project(route.handles[k]);
        const double away = glm::distance(at.pixel, pixel);
        if (at.depth > 0.0 && away <= reach) {
            const Picked found{Picked::Kind::RouteHandle, route.id, int(k),
                               route.handles[k],          away,     at.depth};
            if (better(found, best)) {
                best = found;
            }
        }
    }
}

/// The handle before which a corner at this place of the driven line would go.
int handleAfter(const RouteGlyph& route, const glm::dvec3& place) {
    int best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < route.handles.size(); ++k) {
        const glm::dvec2 a(route.handles[k - 1]), b(route.handles[k]);
        const double away = fromSegment(glm::dvec2(place), a, b).first;
        if (away < least) {
            least = away;
            best = int(k);
        }
    }
    return best;
}

void offerLine(const ViewGeometry& view, const RouteGlyph& route, const glm::dvec2& pixel,
               double reach, std::optional<Picked>& best) {
    for (std::size_t k = 1; k < route.line.size(); ++k) {
        const glm::dvec3& from = route.line[k - 1];
        const glm::dvec3& to = route.line[k];
        const ProjectedPoint a = view.project(from), b = view.project(to);
        if (!(a.depth > 0.0) || !(b.depth > 0.0)) {
            continue;
        }
        const auto [away, share] = fromSegment(pixel, a.pixel, b.pixel);
        if (away > reach) {
            continue;
        }
        // What is even in the picture is not in space: 1/depth is linear along a segment.
        const double t = share * a.depth / (b.depth + share * (a.depth - b.depth));
        const glm::dvec3 point = from + t * (to - from);
        const Picked found{
            Picked::Kind::RouteLine,          route.id, handleAfter(route, point), point, away,
            a.depth + t * (b.depth - a.depth)};
        if (better(found, best)) {
            best = found;
        }
    }
}

/// Where a ray enters a box (slab test); 0 when it starts inside.
std::optional<double> enters(const Ray& ray, const Box& box) {
    double from = 0.0, to = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(ray.direction[axis]) < 1e-12) {
            if (ray.origin[axis] < box.min[axis] || ray.origin[axis] > box.max[axis]) {
                return std::nullopt;
            }
            continue;
        }
        const double a = (box.min[axis] - ray.origin[axis]) / ray.direction[axis];
        const double b = (box.max[axis] - ray.origin[axis]) / ray.direction[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from <= to ? std::optional(from) : std::nullopt;
}

}  // namespace

ProjectItem Picked::item() const {
    switch (kind) {
        case Kind::Probe:
            return {ProjectItem::Kind::Probe, id};
        case Kind::Reflector:
            return {ProjectItem::Kind::Reflector, id};
        case Kind::RouteHandle:
        case Kind::RouteLine:
            break;
    }
    return {ProjectItem::Kind::Route, id};
}

std::optional<double> BoxedReflector::hit(const Ray& ray) const {
    std::optional<double> nearest;
    for (const Body& body : bodies) {
        const RigidTransform body_from_project = body.project_from_body.inverse();
        const Ray local{body_from_project * ray.origin, body_from_project.direction(ray.direction)};
        const std::optional<double> t = enters(local, body.box);
        if (t && (!nearest || *t < *nearest)) {
            nearest = t;
        }
    }
    return nearest;
}

Box BoxedReflector::bounds() const {
    Box all;
    for (const Body& body : bodies) {
        for (int corner = 0; !body.box.empty() && corner < 8; ++corner) {
            const auto side = [&](int axis) {
                return (corner >> axis & 1) != 0 ? body.box.max[axis] : body.box.min[axis];
            };
            all.add(body.project_from_body * glm::dvec3(side(0), side(1), side(2)));
        }
    }
    return all;
}

BoxedReflector ReflectorBoxes::boxed(const PlacedReflector& reflector) {
    auto [known, isNew] = m_boxes.try_emplace(reflector.vehicle);
    for (std::size_t b = 0; isNew && b < reflector.vehicle->bodies.size(); ++b) {
        Box box;
        for (const glm::vec3& v : reflector.vehicle->bodies[b].vertices) {
            box.add(glm::dvec3(v));
        }
        known->second.push_back(box);
    }
    BoxedReflector result{reflector.id, {}};
    for (std::size_t b = 0; b < std::min(known->second.size(), reflector.poses.size()); ++b) {
        result.bodies.push_back({reflector.poses[b], known->second[b]});
    }
    return result;
}

std::vector<BoxedReflector> ReflectorBoxes::boxed(const std::vector<PlacedReflector>& reflectors) {
    std::vector<BoxedReflector> result;
    for (const PlacedReflector& reflector : reflectors) {
        result.push_back(boxed(reflector));
    }
    return result;
}

std::optional<Picked> pick(const ViewGeometry& view, const Pickable& things,
                           const glm::dvec2& pixel, double reach) {
    std::optional<Picked> best;
    for (const RouteGlyph& route : *things.routes) {
        offerHandles(view, route, pixel, reach, best);
    }
    for (const ProbeGlyph& probe : *things.probes) {
        offerProbe(view, probe, pixel, reach, best);
    }
    if (best) {
        return best;
    }
    const Ray ray = view.ray(pixel);
    for (const BoxedReflector& reflector : *things.reflectors) {
        if (const std::optional<double> t = reflector.hit(ray)) {
            const double depth = *t * glm::dot(ray.direction, view.forward());
            if (!best || depth < best->depth) {
                best = Picked{Picked::Kind::Reflector, reflector.id, 0, ray.at(*t), 0.0, depth};
            }
        }
    }
    for (const RouteGlyph& route : *things.routes) {
        if (!best || best->kind == Picked::Kind::RouteLine) {
            offerLine(view, route, pixel, reach, best);
        }
    }
    return best;
}

double nearestStation(const std::vector<glm::dvec3>& line, const glm::dvec3& place) {
    double station = 0.0, before = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < line.size(); ++k) {
        const glm::dvec2 a(line[k - 1]), b(line[k]);
        const double length = glm::distance(a, b);
        const auto [away, share] = fromSegment(glm::dvec2(place), a, b);
        if (away < least) {
            least = away;
            station = before + share * length;
        }
        before += length;
    }
    return station;
}

}  // namespace reflet
