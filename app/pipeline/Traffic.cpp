// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Traffic.h"

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

Route routeInFrame(const RouteSpec& spec, const ProjectFrame& frame) {
    std::vector<glm::dvec3> points;
    points.reserve(spec.points.size());
    for (const auto& point : spec.points)
        points.push_back(point - frame.origin);
    const Route route(std::move(points));
    return spec.cornerRadius > 0.0 ? route.smoothed(spec.cornerRadius) : route;
}

Result<Traffic> Traffic::create(const Project& project) {
    Traffic traffic;
    for (const auto& spec : project.routes)
        traffic.m_routes.emplace(spec.id, routeInFrame(spec, project.frame));
    std::map<std::string, std::shared_ptr<const Vehicle>> vehicles;
    for (const auto& reflector : project.reflectors) {
        auto& vehicle = vehicles[reflector.vehicle];
        if (!vehicle) {
            auto made = builtInVehicle(reflector.vehicle);
            if (!made)
                return tl::unexpected(made.error().in("reflector " + reflector.id));
            vehicle = std::make_shared<const Vehicle>(std::move(*made));
        }
        traffic.m_reflectors.push_back(reflector);
        traffic.m_vehicles.push_back(vehicle);
    }
    return traffic;
}

Result<std::size_t> Traffic::find(const std::string& id) const {
    for (std::size_t i = 0; i < m_reflectors.size(); ++i) {
        if (m_reflectors[i].id == id)
            return i;
    }
    return fail(ErrorCode::Usage, "the project has no reflector of that name", id,
                "Add one with `reflet-cli edit --vehicle ID=tram,ROUTE`.");
}

const Route& Traffic::route(std::size_t reflector) const {
    return m_routes.at(m_reflectors[reflector].route);
}

PlacedReflector Traffic::at(std::size_t reflector, double seconds) const {
    const Reflector& spec = m_reflectors[reflector];
    return atStation(reflector, spec.start + spec.speed * seconds);
}

PlacedReflector Traffic::atStation(std::size_t reflector, double station) const {
    const Route& line = route(reflector);
    const double s = std::clamp(station, 0.0, line.length());
    return {m_reflectors[reflector].id, m_vehicles[reflector], s,
            bodyPoses(*m_vehicles[reflector], line, s)};
}

BodyGeometry::BodyGeometry(const std::vector<PlacedReflector>& reflectors) {
    for (const auto& reflector : reflectors) {
        for (std::size_t i = 0; i < reflector.poses.size(); ++i) {
            m_bodies.push_back({reflector.vehicle.get(), i, reflector.poses[i], nullptr});
            m_vertices.push_back(projectVertices(m_bodies.back()));
            m_occluders.push_back({m_vertices.back(), reflector.vehicle->bodies[i].triangles});
        }
    }
}

}  // namespace reflet
