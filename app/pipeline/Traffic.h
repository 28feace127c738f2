// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/Project.h"
#include "core/rendering/ViewRenderer.h"
#include "core/traffic/Vehicle.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace reflet {

/// A reflector where it is at some time.
struct PlacedReflector {
    std::string id;
    std::shared_ptr<const Vehicle> vehicle;
    double station = 0.0;               ///< metres along its route
    std::vector<RigidTransform> poses;  ///< project frame, one per body

    /// Centre of the local map of a body, project frame.
    [[nodiscard]] glm::dvec3 mapCenter(std::size_t body) const;
    /// The middle body's centre.
    [[nodiscard]] glm::dvec3 middle() const;
    /// Unit driving direction in the plan at the middle body.
    [[nodiscard]] glm::dvec3 heading() const;
};

/// The vehicles of a project and the routes that they drive, in the project frame.
class Traffic {
public:
    /// Usage when a reflector names a vehicle that does not exist.
    [[nodiscard]] static Result<Traffic> create(const Project& project);

    [[nodiscard]] std::size_t size() const { return m_reflectors.size(); }
    [[nodiscard]] const Reflector& reflector(std::size_t i) const { return m_reflectors[i]; }
    /// Index of the reflector with this id.
    [[nodiscard]] Result<std::size_t> find(const std::string& id) const;
    [[nodiscard]] const Route& route(std::size_t reflector) const;
    /// The reflector `seconds` after the start; it waits at the end of its route.
    [[nodiscard]] PlacedReflector at(std::size_t reflector, double seconds) const;
    /// The reflector at a distance along its route.
    [[nodiscard]] PlacedReflector atStation(std::size_t reflector, double station) const;

private:
    std::vector<Reflector> m_reflectors;
    std::vector<std::shared_ptr<const Vehicle>> m_vehicles;
    std::map<std::string, Route> m_routes;
};

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
