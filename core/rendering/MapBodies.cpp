// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rendering/MapBodies.h"

#include "core/baking/RayScene.h"
#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/rendering/BodyShading.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

namespace reflet {
namespace {

/// A ball around a body, as seen from the centre of a map.
struct Ball {
    glm::dvec3 towards{0.0};  // unit
    double sine = 1.0;        // of the half angle that it takes; 1: the centre lies within it
};

Ball ballOf(const Box& bounds, const RigidTransform& pose, const glm::dvec3& center) {
    const glm::dvec3 to = pose * bounds.center() - center;
    const double away = glm::length(to);
    const double radius = 0.5 * glm::length(bounds.size());
    if (away <= radius)
        return {};
    return {to / away, radius / away};
}

/// The cone of directions around a ball, widened by a margin.
struct Cone {
    glm::dvec3 axis{0.0};
    double cosine = -1.0;
    [[nodiscard]] bool holds(const glm::dvec3& unit) const {
        return glm::dot(axis, unit) >= cosine;
    }
};

Box boundsOf(const VehicleBody& body) {
    Box box;
    for (const glm::vec3& v : body.vertices)
        box.add(glm::dvec3(v));
    return box;
}

bool mirrors(const VehicleMaterial& m) {
    return m.clearCoat > 0.0F || m.metallic > 0.0F || m.glass > 0.0F;
}

class MapDrawing {
public:
    MapDrawing(LocalEnvironmentMap& map, const MapBodies& bodies, std::size_t reflector)
        : m_map(map), m_bodies(bodies), m_shading(*bodies.scene, bodies.bodies) {
        for (std::size_t i = 0; i < bodies.bodies.size(); ++i) {
            if (bodies.bodies[i].reflector != reflector)
                addIfSeen(i);
        }
    }

    [[nodiscard]] bool empty() const { return m_indices.empty(); }

    Result<void> build(const JobContext& job) {
        for (const std::size_t i : m_indices)
            m_vertices.push_back(projectVertices(m_bodies.bodies[i]));
        std::vector<Occluder> occluders;
        for (std::size_t k = 0; k < m_indices.size(); ++k) {
            const PlacedBody& body = m_bodies.bodies[m_indices[k]];
            occluders.push_back({m_vertices[k], body.vehicle->bodies[body.body].triangles});
        }
        auto rays = RayScene::build(m_noCity, occluders, job);
        if (!rays)
            return tl::unexpected(rays.error());
        m_rays = std::move(*rays);
        return {};
    }

    /// A row of a face; returns its texels that show a vehicle.
    std::size_t drawRow(int face, int row) {
        const int resolution = m_map.radiance.resolution();
        std::size_t drawn = 0;
        for (int column = 0; column < resolution; ++column) {
            const glm::dvec3 direction =
                glm::normalize(texelDirection(resolution, face, column, row));
            if (std::any_of(m_cones.begin(), m_cones.end(),
                            [&](const Cone& cone) { return cone.holds(direction); }))
                drawn += drawTexel(face, column, row) ? 1 : 0;
        }
        return drawn;
    }

private:
    void addIfSeen(std::size_t i) {
        const PlacedBody& body = m_bodies.bodies[i];
        const Box bounds = boundsOf(body.vehicle->bodies[body.body]);
        const int resolution = m_map.radiance.resolution();
        if (!fillsTexel(bounds, body.project_from_body, m_map.center, resolution))
            return;
        const Ball ball = ballOf(bounds, body.project_from_body, m_map.center);
        const double margin = 1.5 * kPi / resolution;  // more than a texel's diagonal
        const double angle = std::asin(ball.sine) + margin;
        m_cones.push_back({ball.towards, ball.sine < 1.0 && angle < kPi ? std::cos(angle) : -2.0});
        m_indices.push_back(i);
    }

    [[nodiscard]] SceneHit vehicleAlong(const glm::vec3& direction, float nearerThan) const {
        SceneHit hit = m_rays->intersect(glm::vec3(m_map.center), direction, nearerThan);
        if (hit.occluder != kNone)
            hit.occluder = std::uint32_t(m_indices[hit.occluder]);
        return hit;
    }

    /// What the map holds along a ray, as the reference has it.
    [[nodiscard]] std::optional<SceneHit> cityAlong(const glm::vec3& direction) const {
        if (m_bodies.city == nullptr)
            return std::nullopt;
        return m_bodies.city->intersect(glm::vec3(m_map.center), direction);
    }

    bool drawTexel(int face, int column, int row) {
        const int n = m_map.radiance.resolution();
        const int samples = m_bodies.samplesPerEdge;
        const float behind = m_map.distance.at(face, column, row);
        const glm::vec3 origin(m_map.center);
        glm::vec3 sum(0.0F);
        int met = 0;
        for (int k = 0; k < samples * samples; ++k) {
            const glm::dvec2 place((k % samples + 0.5) / samples, (k / samples + 0.5) / samples);
            const glm::dvec2 st(2.0 * (column + place.x) / n - 1.0,
                                2.0 * (row + place.y) / n - 1.0);
            const glm::vec3 direction(glm::normalize(faceDirection(face, st)));
            const auto city = cityAlong(direction);
            const SceneHit hit = vehicleAlong(direction, city ? city->distance : behind);
            if (hit.occluder != kNone) {
                sum += m_shading.inMirror(origin, direction, hit);
                ++met;
            } else if (city) {
                const float spread = float(0.5 * kPi / n / samples);
                sum += m_bodies.city->shade(*city, origin, direction, spread);
            } else {
                sum += m_map.radiance.at(face, column, row);
            }
        }
        const glm::vec3 middle(glm::normalize(texelDirection(n, face, column, row)));
        const SceneHit central = vehicleAlong(middle, behind);
        if (central.occluder != kNone) {
            m_map.distance.at(face, column, row) = central.distance;
            m_map.uncovered.at(face, column, row) = 0;
        }
        if (met > 0)
            m_map.radiance.at(face, column, row) = sum / float(samples * samples);
        return met > 0 || central.occluder != kNone;
    }

    LocalEnvironmentMap& m_map;
    const MapBodies& m_bodies;
    BodyShading m_shading;
    CityModel m_noCity;
    std::vector<std::size_t> m_indices;  // of the bodies that are drawn
    std::vector<Cone> m_cones;
    std::vector<std::vector<glm::vec3>> m_vertices;
    std::unique_ptr<RayScene> m_rays;
};

}  // namespace

bool reflectsAnything(const Vehicle& vehicle) {
    return std::any_of(vehicle.materials.begin(), vehicle.materials.end(), mirrors);
}

bool fillsTexel(const Box& bounds, const RigidTransform& project_from_body,
                const glm::dvec3& mapCenter, int resolution) {
    if (bounds.empty() || resolution < 1)
        return false;
    const Ball ball = ballOf(bounds, project_from_body, mapCenter);
    return 2.0 * std::asin(ball.sine) > 0.5 * kPi / resolution;
}

Result<std::size_t> drawIntoMap(LocalEnvironmentMap& map, std::size_t reflector,
                                const MapBodies& bodies, const JobContext& job) {
    MapDrawing drawing(map, bodies, reflector);
    if (drawing.empty())
        return std::size_t(0);
    if (auto built = drawing.build(job); !built)
        return tl::unexpected(built.error());
    const auto edge = std::size_t(map.radiance.resolution());
    std::atomic<std::size_t> drawn{0};
    parallelFor(0, 6 * edge, 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t line = first; line < last && !job.cancelled(); ++line)
            drawn += drawing.drawRow(int(line / edge), int(line % edge));
    });
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    return drawn.load();
}

}  // namespace reflet
