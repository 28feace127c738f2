// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/Timetable.h"

#include "core/traffic/TrafficFlow.h"

#include <algorithm>
#include <cmath>

namespace reflet {

VehicleExtent extentOf(const Vehicle& vehicle) {
    VehicleExtent out{0.1, 0.1, 0.1, 0.1};
    for (const VehicleBody& body : vehicle.bodies) {
        for (const glm::vec3& v : body.vertices) {
            const double x = body.offset + double(v.x);
            out.front = std::max(out.front, x);
            out.rear = std::max(out.rear, -x);
            out.half = std::max(out.half, std::abs(double(v.y)));
            out.height = std::max(out.height, double(v.z));
        }
    }
    return out;
}

Timetable Timetable::steady(const std::vector<Drive>& drives) {
    Timetable table;
    for (const Drive& drive : drives)
        table.m_courses.push_back({drive.start, drive.speed, drive.route->length(), {}});
    return table;
}

Timetable::Timetable(const std::vector<Drive>& drives) : Timetable(steady(drives)) {
    TrafficFlow flow(drives);
    if (!flow.interacts())
        return;
    const auto steps = std::size_t(kLongest / kStep);
    for (std::size_t step = 0; step <= steps && !flow.settled(); ++step) {
        for (std::size_t i = 0; i < drives.size(); ++i) {
            if (flow.interacts(i))
                m_courses[i].stations.push_back(flow.station(i));
        }
        flow.advance();
    }
    for (std::size_t i = 0; i < drives.size(); ++i) {
        if (flow.interacts(i))
            m_courses[i].stations.push_back(flow.station(i));
    }
}

double Timetable::Course::at(double seconds) const {
    if (stations.empty())
        return std::clamp(start + speed * seconds, 0.0, length);
    const double place = std::max(seconds, 0.0) / kStep;
    const auto i = std::size_t(std::min(place, double(stations.size() - 1)));
    if (i + 1 >= stations.size())
        return stations.back();
    return stations[i] + (stations[i + 1] - stations[i]) * (place - double(i));
}

double Timetable::Course::lastMove() const {
    if (stations.empty())
        return speed > 0.0 ? std::max(0.0, (length - start) / speed) : 0.0;
    const auto reached = std::lower_bound(stations.begin(), stations.end(), stations.back());
    return kStep * double(reached - stations.begin());
}

double Timetable::station(std::size_t drive, double seconds) const {
    return m_courses[drive].at(seconds);
}

double Timetable::speed(std::size_t drive, double seconds) const {
    const Course& course = m_courses[drive];
    const double before = std::max(seconds - kStep, 0.0);
    return (course.at(before + 2.0 * kStep) - course.at(before)) / (2.0 * kStep);
}

double Timetable::secondsAt(std::size_t drive, double station) const {
    const Course& course = m_courses[drive];
    if (course.stations.empty()) {
        return course.speed > 0.0 ? std::clamp((station - course.start) / course.speed, 0.0,
                                               std::max(course.lastMove(), 0.0))
                                  : 0.0;
    }
    const std::vector<double>& all = course.stations;
    if (station <= all.front())
        return 0.0;
    const auto next = std::lower_bound(all.begin(), all.end(), station);
    if (next == all.end())
        return course.lastMove();
    const double before = *(next - 1);
    return kStep * (double(next - all.begin()) - (*next - station) / (*next - before));
}

double Timetable::duration() const {
    double longest = 0.0;
    for (const Course& course : m_courses)
        longest = std::max(longest, course.lastMove());
    return longest;
}

}  // namespace reflet
