// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/Route.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace reflet {
namespace {

constexpr double kSamePoint = 1e-6;     // metres in the plan: closer points are one
constexpr double kSampleSpacing = 0.5;  // metres, of a smoothed route

double planDistance(const glm::dvec3& a, const glm::dvec3& b) {
    return std::hypot(b.x - a.x, b.y - a.y);
}

glm::dvec2 planDirection(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::dvec2(b.x - a.x, b.y - a.y) / planDistance(a, b);
}

/// A corner b of the polyline a, b, c and how it is cut: the arc touches both legs `trim` metres
/// from the corner. With the turn angle θ, trim = radius · tan(θ/2).
struct Corner {
    double turn = 0.0;  // signed, counter-clockwise positive
    double trim = 0.0;
};

Corner cornerAt(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double radius,
                double room) {
    const glm::dvec2 in = planDirection(a, b);
    const glm::dvec2 out = planDirection(b, c);
    const double turn = std::atan2(in.x * out.y - in.y * out.x, glm::dot(in, out));
    return {turn, std::min(radius * std::tan(0.5 * std::abs(turn)), room)};
}

/// Points from `from` (already in the list) to `to`, evenly spaced, ends with `to`.
void appendStraight(std::vector<glm::dvec3>& points, const glm::dvec3& to) {
    const glm::dvec3 from = points.back();
    const double length = planDistance(from, to);
    if (length < kSamePoint) {
        return;
    }
    const int count = std::max(1, int(std::ceil(length / kSampleSpacing - 1e-9)));
    for (int i = 1; i <= count; ++i) {
        points.push_back(glm::mix(from, to, double(i) / count));
    }
}

/// The arc that replaces the corner b. Heights follow the quadratic Bézier curve of the three
/// points, which keeps the slope continuous where arc and legs meet.
void appendArc(std::vector<glm::dvec3>& points, const glm::dvec3& a, const glm::dvec3& b,
               const glm::dvec3& c, const Corner& corner) {
    const glm::dvec3 start = b + (a - b) * (corner.trim / planDistance(a, b));
    const glm::dvec3 end = b + (c - b) * (corner.trim / planDistance(b, c));
    appendStraight(points, start);
    const double radius = corner.trim / std::tan(0.5 * std::abs(corner.turn));
    const glm::dvec2 in = planDirection(a, b);
    const glm::dvec2 left(-in.y, in.x);
    const double side = corner.turn > 0.0 ? 1.0 : -1.0;
    const glm::dvec2 center = glm::dvec2(start) + left * (side * radius);
    const double arc = radius * std::abs(corner.turn);
    const int count = std::max(2, int(std::ceil(arc / kSampleSpacing)));
    for (int i = 1; i <= count; ++i) {
        const double t = double(i) / count;
        const double angle = corner.turn * t;
        const glm::dvec2 spoke = -left * (side * radius);
        const glm::dvec2 turned(spoke.x * std::cos(angle) - spoke.y * std::sin(angle),
                                spoke.x * std::sin(angle) + spoke.y * std::cos(angle));
        const double z = (1 - t) * (1 - t) * start.z + 2 * t * (1 - t) * b.z + t * t * end.z;
        points.emplace_back(center + turned, z);
    }
}

}  // namespace

Route::Route(std::vector<glm::dvec3> points) {
    for (const glm::dvec3& p : points) {
        assert(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        if (m_points.empty() || planDistance(m_points.back(), p) > kSamePoint) {
            m_points.push_back(p);
        }
    }
    assert(m_points.size() >= 2 && "a route needs two distinct points");
    m_distance.reserve(m_points.size());
    m_distance.push_back(0.0);
    for (std::size_t i = 1; i < m_points.size(); ++i) {
        m_distance.push_back(m_distance.back() + planDistance(m_points[i - 1], m_points[i]));
    }
    m_length = m_distance.back();
}

glm::dvec3 Route::at(double s) const {
    if (!(s > 0.0)) {
        return m_points.front();
    }
    if (s >= m_length) {
        return m_points.back();
    }
    const auto next = std::upper_bound(m_distance.begin(), m_distance.end(), s);
    const auto i = std::size_t(next - m_distance.begin());
    const double t = (s - m_distance[i - 1]) / (m_distance[i] - m_distance[i - 1]);
    return glm::mix(m_points[i - 1], m_points[i], t);
}

glm::dvec3 Route::tangent(double s) const {
    const auto next = std::upper_bound(m_distance.begin(), m_distance.end(), s);
    const auto i =
        std::clamp<std::size_t>(std::size_t(next - m_distance.begin()), 1, m_points.size() - 1);
    return {planDirection(m_points[i - 1], m_points[i]), 0.0};
}

Route Route::smoothed(double radius) const {
    std::vector<glm::dvec3> points{m_points.front()};
    const std::size_t last = m_points.size() - 1;
    for (std::size_t i = 1; i < last; ++i) {
        const glm::dvec3& a = m_points[i - 1];
        const glm::dvec3& b = m_points[i];
        const glm::dvec3& c = m_points[i + 1];
        // Two arcs share the leg between their corners; the first and the last leg have one.
        const double before = planDistance(a, b) * (i == 1 ? 1.0 : 0.5);
        const double after = planDistance(b, c) * (i + 1 == last ? 1.0 : 0.5);
        const Corner corner = cornerAt(a, b, c, std::max(radius, 0.0), std::min(before, after));
        const bool turnsBack = std::abs(corner.turn) > 3.1;
        if (corner.trim > 1e-3 && std::abs(corner.turn) > 1e-6 && !turnsBack) {
            appendArc(points, a, b, c, corner);
        } else {
            appendStraight(points, b);
        }
    }
    appendStraight(points, m_points.back());
    return Route(std::move(points));
}

std::vector<double> Route::stations(double step) const {
    assert(step > 0.0);
    const auto count = std::max<std::size_t>(1, std::size_t(std::ceil(m_length / step - 1e-9)));
    std::vector<double> result;
    result.reserve(count + 1);
    for (std::size_t i = 0; i <= count; ++i) {
        result.push_back(m_length * double(i) / double(count));
    }
    return result;
}

}  // namespace reflet
