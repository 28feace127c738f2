// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/square/SquarePlan.h"

#include "core/samples/kit/Ground.h"

#include <cmath>

namespace reflet::square {

namespace {

constexpr double kAvenueAxis = 6.0;
constexpr double kParkAxis = 20.0;
constexpr double kBendRadius = 28.0;
constexpr glm::dvec2 kBendCenter{162.0, kParkAxis - kBendRadius};
constexpr double kRouteStart = -225.0;
constexpr double kRouteLength = 480.0;

/// Two arcs that shift the track sideways by d over the length L: each has the radius
/// (L² + d²) / (4 d), here 148 m, and they meet in the middle.
void addShift(std::vector<glm::dvec2>& line, double x0, double x1, double y0, double y1) {
    const double length = x1 - x0, shift = y1 - y0;
    const double radius = (length * length + shift * shift) / (4.0 * shift);
    constexpr int kSteps = 48;
    for (int i = 0; i <= 2 * kSteps; ++i) {
        const double x = length * i / (2.0 * kSteps);
        const double from = i <= kSteps ? x : length - x;
        const double rise = radius - std::sqrt(radius * radius - from * from);
        line.emplace_back(x0 + x, i <= kSteps ? y0 + rise : y1 - rise);
    }
}

}  // namespace

std::vector<glm::dvec2> tramAxis() {
    std::vector<glm::dvec2> line{
        {-376.0, kAvenueAxis}, {-300.0, kAvenueAxis}, {-150.0, kAvenueAxis}};
    addShift(line, -45.0, 45.0, kAvenueAxis, kParkAxis);
    constexpr int kSteps = 40;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = 0.5 * kPi * (1.0 - double(i) / kSteps);
        line.push_back(kBendCenter + kBendRadius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    line.emplace_back(190.0, -120.0);
    line.emplace_back(190.0, -256.0);
    return line;
}

std::vector<glm::dvec2> tramRoute() {
    const std::vector<glm::dvec2> axis = tramAxis();
    std::vector<glm::dvec2> line{{kRouteStart, kAvenueAxis - 0.5 * kTrackSpacing}};
    double length = 0.0;
    for (std::size_t i = 0; i < axis.size(); ++i) {
        const glm::dvec2 next = kit::parallelPoint(axis, i, -0.5 * kTrackSpacing);
        if (next.x <= kRouteStart) {
            continue;
        }
        const double part = glm::length(next - line.back());
        if (length + part >= kRouteLength) {
            line.push_back(glm::mix(line.back(), next, (kRouteLength - length) / part));
            break;
        }
        length += part;
        line.push_back(next);
    }
    return line;
}

std::vector<glm::dvec2> parkLane() {
    const std::vector<glm::dvec2> axis = tramAxis();
    std::vector<glm::dvec2> line{{67.5, 120.0}, {67.5, 26.5}};
    for (std::size_t i = 0; i < axis.size(); ++i) {
        const glm::dvec2 p = kit::parallelPoint(axis, i, 6.5);
        if (p.x > 80.0 && p.y > -110.0) {
            line.push_back(p);
        }
    }
    line.emplace_back(196.5, -200.0);
    return line;
}

std::vector<glm::dvec2> avenueLane() {
    return {{-330.0, -0.6}, {-154.0, -0.6}, {-154.0, -100.0}};
}

std::vector<glm::dvec2> stationsAlong(const std::vector<glm::dvec2>& line, double start,
                                      double step) {
    std::vector<glm::dvec2> stations;
    double next = start, walked = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const double part = glm::length(line[i + 1] - line[i]);
        while (next <= walked + part) {
            stations.push_back(glm::mix(line[i], line[i + 1], (next - walked) / part));
            next += step;
        }
        walked += part;
    }
    return stations;
}

}  // namespace reflet::square
