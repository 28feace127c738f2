// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Traffic.h"

#include "app/pipeline/VehicleCache.h"
#include "app/pipeline/VehicleFile.h"
#include "core/geo/FramePosition.h"

#include <algorithm>
#include <map>

namespace reflet {

Route routeInFrame(const RouteSpec& spec, const ProjectFrame& frame) {
    std::vector<glm::dvec3> points;
    points.reserve(spec.points.size());
    for (const auto& point : spec.points)
        points.push_back(frameFromAbsolute(frame, point));
    const Route route(std::move(points));
    return spec.cornerRadius > 0.0 ? route.smoothed(spec.cornerRadius) : route;
}

std::filesystem::path vehiclePath(const VehicleModel& vehicle,
                                  const std::filesystem::path& folder) {
    return (folder / vehicle.path).lexically_normal();
}

Result<std::shared_ptr<const Vehicle>> vehicleOf(const Project& project, const std::string& name,
                                                 const std::filesystem::path& folder) {
    const auto own = std::find_if(project.vehicles.begin(), project.vehicles.end(),
                                  [&](const VehicleModel& model) { return model.id == name; });
    if (own != project.vehicles.end()) {
        auto loaded = loadVehicle(*own, folder, {});
        if (!loaded)
            return tl::unexpected(loaded.error());
        return std::make_shared<const Vehicle>(std::move(*loaded));
    }
    auto made = builtInVehicle(name);
    if (!made)
        return tl::unexpected(made.error());
    return std::make_shared<const Vehicle>(std::move(*made));
}

namespace {

Result<std::shared_ptr<const Vehicle>> keptVehicle(const std::string& name,
                                                   const std::filesystem::path& cache) {
    auto made = builtInVehicle(name, VehicleCache(cache));
    if (!made)
        return tl::unexpected(made.error());
    return std::make_shared<const Vehicle>(std::move(*made));
}

}  // namespace

Result<std::shared_ptr<const Vehicle>> VehicleShelf::take(const Project& project,
                                                          const std::string& name,
                                                          const std::filesystem::path& folder,
                                                          const std::filesystem::path& cache) {
    const auto own = std::find_if(project.vehicles.begin(), project.vehicles.end(),
                                  [&](const VehicleModel& model) { return model.id == name; });
    Kept wanted;
    if (own != project.vehicles.end()) {
        wanted.model = *own;
        wanted.file = vehiclePath(*own, folder);
        std::error_code error;
        wanted.written = std::filesystem::last_write_time(wanted.file, error);
    }
    {
        const std::lock_guard lock(m_mutex);
        const auto found = m_kept.find(name);
        if (found != m_kept.end() && found->second.model == wanted.model &&
            found->second.file == wanted.file && found->second.written == wanted.written) {
            return found->second.vehicle;
        }
    }
    auto made =
        wanted.model || cache.empty() ? vehicleOf(project, name, folder) : keptVehicle(name, cache);
    if (made) {
        wanted.vehicle = *made;
        const std::lock_guard lock(m_mutex);
        m_kept[name] = wanted;
    }
    return made;
}

Result<Traffic> trafficOf(const Project& project, const std::filesystem::path& folder,
                          VehicleShelf& shelf, const std::filesystem::path& cache) {
    std::map<std::string, std::shared_ptr<const Route>> routes;
    for (const auto& spec : project.routes)
        routes[spec.id] = std::make_shared<const Route>(routeInFrame(spec, project.frame));
    Traffic traffic;
    std::map<std::string, std::shared_ptr<const Vehicle>> vehicles;
    for (const auto& reflector : project.reflectors) {
        auto& vehicle = vehicles[reflector.vehicle];
        if (!vehicle) {
            auto made = shelf.take(project, reflector.vehicle, folder, cache);
            if (!made)
                return tl::unexpected(made.error().in("reflector " + reflector.id));
            vehicle = std::move(*made);
        }
        traffic.add({reflector.id, reflector.route, vehicle, routes.at(reflector.route),
                     reflector.speed, reflector.start, reflector.interest});
    }
    traffic.settle();
    return traffic;
}

Result<Traffic> trafficOf(const Project& project, const std::filesystem::path& folder) {
    VehicleShelf shelf;
    return trafficOf(project, folder, shelf);
}

BodyGeometry::BodyGeometry(const std::vector<PlacedReflector>& reflectors) {
    for (std::size_t r = 0; r < reflectors.size(); ++r) {
        const PlacedReflector& reflector = reflectors[r];
        for (std::size_t i = 0; i < reflector.poses.size(); ++i) {
            m_bodies.push_back(
                {reflector.vehicle.get(), i, reflector.poses[i], nullptr, nullptr, r});
            m_vertices.push_back(projectVertices(m_bodies.back()));
            m_occluders.push_back({m_vertices.back(), reflector.vehicle->bodies[i].triangles});
        }
    }
}

}  // namespace reflet
