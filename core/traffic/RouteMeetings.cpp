// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/RouteMeetings.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace reflet {
namespace {

constexpr double kLong = 15.0;  // metres: shorter places are crossed, not followed

glm::dvec2 directionAt(const std::vector<glm::dvec3>& points, std::size_t i) {
    const std::size_t next = std::min(i + 1, points.size() - 1);
    const glm::dvec2 d(points[next] - points[next == i ? i - 1 : i]);
    const double length = glm::length(d);
    return length > 0.0 ? d / length : glm::dvec2(1.0, 0.0);
}

/// The samples of the second route that are near a point.
std::optional<Stretch> nearTo(const glm::dvec3& point, const std::vector<glm::dvec3>& points,
                              double distance, double height) {
    std::optional<Stretch> found;
    for (std::size_t j = 0; j < points.size();) {
        const double away = glm::distance(glm::dvec2(points[j]), glm::dvec2(point));
        if (away >= distance) {  // no sample before this many metres can be near
            j += std::max<std::size_t>(1, std::size_t(away - distance));
            continue;
        }
        if (std::abs(points[j].z - point.z) < height)
            found = Stretch{found ? found->from : double(j), double(j)};
        ++j;
    }
    return found;
}

}  // namespace

std::vector<glm::dvec3> sampled(const Route& route) {
    std::vector<glm::dvec3> points;
    const int count = int(std::ceil(route.length()));
    for (int i = 0; i <= count; ++i)
        points.push_back(route.at(double(i)));
    return points;
}

std::vector<Meeting> meetings(const std::vector<glm::dvec3>& first,
                              const std::vector<glm::dvec3>& second, double distance,
                              double height) {
    std::vector<Meeting> found;
    bool open = false;
    double aligned = 0.0;
    const auto close = [&] {
        if (open) {
            Meeting& last = found.back();
            const double length = last.first.to - last.first.from + 1.0;
            last.along = aligned > 0.5 * length && length > kLong;
        }
        open = false;
        aligned = 0.0;
    };
    for (std::size_t i = 0; i < first.size(); ++i) {
        const auto near = nearTo(first[i], second, distance, height);
        if (!near) {
            close();
            continue;
        }
        if (!open)
            found.push_back({{double(i), double(i)}, *near, false});
        open = true;
        Meeting& meeting = found.back();
        meeting.first.to = double(i);
        meeting.second.from = std::min(meeting.second.from, near->from);
        meeting.second.to = std::max(meeting.second.to, near->to);
        const auto middle = std::size_t(0.5 * (near->from + near->to));
        aligned += glm::dot(directionAt(first, i), directionAt(second, middle)) > 0.5 ? 1.0 : 0.0;
    }
    close();
    return found;
}

}  // namespace reflet
