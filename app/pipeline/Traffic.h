// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/Project.h"
#include "core/rendering/ViewRenderer.h"
#include "core/traffic/Traffic.h"

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// The vehicles of a project and the routes that they drive, in the project frame. `folder` is the
/// project file's: paths of the user's vehicles start there. Usage when a reflector names a vehicle
/// that does not exist; Unreadable and Refused name the reflector and the vehicle's file.
[[nodiscard]] Result<Traffic> trafficOf(const Project& project,
                                        const std::filesystem::path& folder);

/// Vehicles that were made or read before, for a project that changes: a vehicle is made anew only
/// when its entry or its file has changed. Safe to use from several threads.
class VehicleShelf {
public:
    /// As vehicleOf(). Built-in vehicles are looked for in the cache folder, and kept there; an
    /// empty one keeps nothing.
    [[nodiscard]] Result<std::shared_ptr<const Vehicle>> take(const Project& project,
                                                              const std::string& name,
                                                              const std::filesystem::path& folder,
                                                              const std::filesystem::path& cache);

private:
    struct Kept {
        std::optional<VehicleModel> model;  ///< nullopt: built in
        std::filesystem::path file;
        std::filesystem::file_time_type written;
        std::shared_ptr<const Vehicle> vehicle;
    };
    std::mutex m_mutex;
    std::map<std::string, Kept> m_kept;
};
[[nodiscard]] Result<Traffic> trafficOf(const Project& project, const std::filesystem::path& folder,
                                        VehicleShelf& shelf,
                                        const std::filesystem::path& cache = {});

/// The vehicle that a reflector names: a built-in one, or one of the project's, read from its file.
[[nodiscard]] Result<std::shared_ptr<const Vehicle>> vehicleOf(const Project& project,
                                                               const std::string& name,
                                                               const std::filesystem::path& folder);

/// The file of a vehicle of the project, made absolute.
[[nodiscard]] std::filesystem::path vehiclePath(const VehicleModel& vehicle,
                                                const std::filesystem::path& folder);

/// The route of a project in the project frame, corners rounded.
[[nodiscard]] Route routeInFrame(const RouteSpec& spec, const ProjectFrame& frame);

/// Meshes of placed bodies in the project frame, kept alive for a scene that has them as occluders.
class BodyGeometry {
public:
    explicit BodyGeometry(const std::vector<PlacedReflector>& reflectors);
    [[nodiscard]] const std::vector<Occluder>& occluders() const { return m_occluders; }
    /// In the order of occluders(); maps are null.
    [[nodiscard]] const std::vector<PlacedBody>& bodies() const { return m_bodies; }

private:
    std::vector<std::vector<glm::vec3>> m_vertices;
    std::vector<Occluder> m_occluders;
    std::vector<PlacedBody> m_bodies;
};

}  // namespace reflet
