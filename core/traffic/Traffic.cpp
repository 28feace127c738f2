// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/Traffic.h"

#include <algorithm>

namespace reflet {

glm::dvec3 PlacedReflector::mapCenter(std::size_t body) const {
    return poses[body] * glm::dvec3(vehicle->bodies[body].center);
}

glm::dvec3 PlacedReflector::middle() const {
    return mapCenter(poses.size() / 2);
}

glm::dvec3 PlacedReflector::heading() const {
    return poses[poses.size() / 2].direction(glm::dvec3(1.0, 0.0, 0.0));
}

Result<std::size_t> Traffic::find(const std::string& id) const {
    for (std::size_t i = 0; i < m_drives.size(); ++i) {
        if (m_drives[i].id == id)
            return i;
    }
    return fail(ErrorCode::Usage, "the project has no reflector of that name", id,
                "Add one with `reflet-cli edit --vehicle ID=tram,ROUTE`.");
}

void Traffic::add(Drive drive) {
    m_drives.push_back(std::move(drive));
    m_timetable = std::make_shared<const Timetable>(Timetable::steady(m_drives));
}

PlacedReflector Traffic::at(std::size_t i, double seconds) const {
    const Drive& drive = m_drives[i];
    const double s = m_timetable->station(i, seconds);
    if (!drive.vehicle->walks)
        return atStation(i, s);
    const double stride = drive.speed > 0.0
                              ? std::clamp(m_timetable->speed(i, seconds) / drive.speed, 0.0, 1.0)
                              : 0.0;
    return {drive.id, drive.vehicle, s, bodyPoses(*drive.vehicle, *drive.route, s, stride),
            drive.interest};
}

PlacedReflector Traffic::atStation(std::size_t i, double station) const {
    const Drive& drive = m_drives[i];
    const double s = std::clamp(station, 0.0, drive.route->length());
    return {drive.id, drive.vehicle, s, bodyPoses(*drive.vehicle, *drive.route, s), drive.interest};
}

std::vector<PlacedReflector> Traffic::at(double seconds) const {
    std::vector<PlacedReflector> placed;
    for (std::size_t i = 0; i < m_drives.size(); ++i)
        placed.push_back(at(i, seconds));
    return placed;
}

}  // namespace reflet
