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

PlacedReflector Traffic::at(std::size_t i, double seconds) const {
    return atStation(i, m_drives[i].start + m_drives[i].speed * seconds);
}

PlacedReflector Traffic::atStation(std::size_t i, double station) const {
    const Drive& drive = m_drives[i];
    const double s = std::clamp(station, 0.0, drive.route->length());
    return {drive.id, drive.vehicle, s, bodyPoses(*drive.vehicle, *drive.route, s)};
}

std::vector<PlacedReflector> Traffic::at(double seconds) const {
    std::vector<PlacedReflector> placed;
    for (std::size_t i = 0; i < m_drives.size(); ++i)
        placed.push_back(at(i, seconds));
    return placed;
}

double Traffic::duration() const {
    double longest = 0.0;
    for (const Drive& drive : m_drives) {
        if (drive.speed > 0.0) {
            longest = std::max(longest, (drive.route->length() - drive.start) / drive.speed);
        }
    }
    return longest;
}

}  // namespace reflet
