// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/Vehicle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

/// Where the two pivots of a body are: in the straight vehicle (relative to its middle), or as
/// distances along the route.
struct Pivots {
    double rear = 0.0;
    double front = 0.0;
};

/// The route, continued straight beyond its ends at their slope-free tangent.
glm::dvec3 pointOn(const Route& route, double s) {
    const double inside = std::clamp(s, 0.0, route.length());
    return route.at(inside) + route.tangent(inside) * (s - inside);
}

/// The smallest x >= x0 with distanceAt(x) = chord, for a distance that is at most `chord` at x0;
/// on a hairpin too tight for the vehicle, where there is none in reach, 2 x0.
template <class Distance>
double solveChord(double x0, double chord, Distance distanceAt) {
    constexpr double kStep = 0.1;  // metres
    double low = x0;
    double high = x0;
    while (distanceAt(high) < chord) {
        low = high;
        high += kStep;
        if (high > 2.0 * x0 + kStep) {
            return 2.0 * x0;
        }
    }
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (distanceAt(middle) < chord ? low : high) = middle;
    }
    return high;
}

/// The pivot that lies `span` metres (straight, in space) before or behind the one at s.
double nextPivot(const Route& route, double s, double span, double direction) {
    const glm::dvec3 from = pointOn(route, s);
    return s + direction * solveChord(span, span, [&](double d) {
                   return glm::distance(from, pointOn(route, s + direction * d));
               });
}

/// Both pivots, evenly to both sides of s.
Pivots around(const Route& route, double s, double span) {
    const double half = solveChord(0.5 * span, span, [&](double d) {
        return glm::distance(pointOn(route, s - d), pointOn(route, s + d));
    });
    return {s - half, s + half};
}

RigidTransform poseOf(const Route& route, const VehicleBody& body, const Pivots& pivots,
                      bool upright) {
    const glm::dvec3 rear = pointOn(route, pivots.rear);
    const glm::dvec3 front = pointOn(route, pivots.front);
    const bool apart = glm::distance(front, rear) > 1e-6;
    const bool level = upright || !apart;
    const glm::dvec3 x = level ? route.tangent(pivots.rear) : glm::normalize(front - rear);
    const glm::dvec3 y = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), x));
    const glm::dvec3 z = glm::cross(x, y);
    return {glm::dmat3(x, y, z), 0.5 * (rear + front) - x * body.pivotMiddle};
}

bool same(double a, double b) {
    return std::abs(a - b) < 1e-6;
}

/// Front and rear end of the straight vehicle, from its middle.
Pivots extent(const Vehicle& vehicle) {
    Pivots ends{1e300, -1e300};
    for (const VehicleBody& body : vehicle.bodies) {
        const double pivots = body.offset + body.pivotMiddle;
        ends.rear = std::min(ends.rear, pivots - 0.5 * body.pivotSpan);
        ends.front = std::max(ends.front, pivots + 0.5 * body.pivotSpan);
        for (const glm::vec3& v : body.vertices) {
            ends.rear = std::min(ends.rear, body.offset + double(v.x));
            ends.front = std::max(ends.front, body.offset + double(v.x));
        }
    }
    return ends;
}

constexpr double kStrideOfHip = 1.65;  // metres walked by two steps, per metre of the hip's height

/// Limbs swing about their hinges, and the whole person sinks by what the legs' slant takes.
void walk(const Vehicle& vehicle, double s, double stride, std::vector<RigidTransform>& poses) {
    double hip = 0.0, swing = 0.0;
    for (const VehicleBody& body : vehicle.bodies) {
        if (body.swing != 0.0 && (hip == 0.0 || body.hinge.z < hip)) {
            hip = body.hinge.z;
            swing = body.swing;
        }
    }
    if (hip <= 0.0)
        return;
    const double turn = stride * std::sin(2.0 * kPi * s / (kStrideOfHip * hip));
    const double sunk = hip * (1.0 - std::cos(swing * turn));
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const VehicleBody& body = vehicle.bodies[i];
        const double c = std::cos(body.swing * turn);
        const double w = std::sin(body.swing * turn);
        const glm::dmat3 swung(c, 0, -w, 0, 1, 0, w, 0, c);
        const glm::dvec3 moved = body.hinge - swung * body.hinge - glm::dvec3(0.0, 0.0, sunk);
        poses[i].translation = poses[i] * moved;
        poses[i].rotation = poses[i].rotation * swung;
    }
}

double clampToRoute(const Vehicle& vehicle, const Route& route, double s) {
    const Pivots ends = extent(vehicle);
    const double low = -ends.rear;
    const double high = route.length() - ends.front;
    return low <= high ? std::clamp(s, low, high) : 0.5 * (low + high);
}

}  // namespace

std::vector<RigidTransform> bodyPoses(const Vehicle& vehicle, const Route& route, double s,
                                      double stride) {
    const std::size_t count = vehicle.bodies.size();
    if (count == 0) {
        return {};
    }
    const double middle = clampToRoute(vehicle, route, s);
    std::vector<Pivots> straight;
    std::size_t lead = 0;  // the body whose pivots are nearest to the vehicle's middle
    for (std::size_t i = 0; i < count; ++i) {
        const VehicleBody& body = vehicle.bodies[i];
        const double at = body.offset + body.pivotMiddle;
        straight.push_back({at - 0.5 * body.pivotSpan, at + 0.5 * body.pivotSpan});
        const VehicleBody& best = vehicle.bodies[lead];
        if (std::abs(at) < std::abs(best.offset + best.pivotMiddle) - 1e-9) {
            lead = i;
        }
    }
    std::vector<Pivots> placed(count);
    placed[lead] = around(route, middle + 0.5 * (straight[lead].rear + straight[lead].front),
                          vehicle.bodies[lead].pivotSpan);
    // Bodies are listed from the front to the rear; from the leading one the chain of joints goes
    // on.
    for (std::size_t i = lead; i-- > 0;) {
        if (same(straight[i].rear, straight[i + 1].rear) &&
            same(straight[i].front, straight[i + 1].front)) {
            placed[i] = placed[i + 1];
            continue;
        }
        placed[i].rear = placed[i + 1].front + (straight[i].rear - straight[i + 1].front);
        placed[i].front = nextPivot(route, placed[i].rear, vehicle.bodies[i].pivotSpan, 1.0);
    }
    for (std::size_t i = lead + 1; i < count; ++i) {
        if (same(straight[i].rear, straight[i - 1].rear) &&
            same(straight[i].front, straight[i - 1].front)) {
            placed[i] = placed[i - 1];
            continue;
        }
        placed[i].front = placed[i - 1].rear + (straight[i].front - straight[i - 1].rear);
        placed[i].rear = nextPivot(route, placed[i].front, vehicle.bodies[i].pivotSpan, -1.0);
    }
    std::vector<RigidTransform> poses;
    for (std::size_t i = 0; i < count; ++i) {
        poses.push_back(poseOf(route, vehicle.bodies[i], placed[i], vehicle.walks));
    }
    if (vehicle.walks) {
        walk(vehicle, middle, stride, poses);
    }
    return poses;
}

}  // namespace reflet
