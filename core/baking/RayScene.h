// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

namespace reflet {

/// How many rays Embree is handed at a time, and whether it is told that they are alike.
struct RayPackets {
    int size = 16;  ///< 1, 8 or 16
    bool coherent = true;
};

/// Rays of one origin, component by component.
struct RayBundle {
    glm::vec3 origin{0.0F};
    std::span<const float> x, y, z;  ///< of the directions, any length; as many of each
};

/// The triangles of a city (and of occluders) in an Embree BVH: robust, two-sided, safe to use from
/// several threads. Directions have unit length; distances are metres.
class RayScene {
public:
    /// Cancelled when the job is; ResourceLimit when Embree has no memory; Internal otherwise.
    [[nodiscard]] static Result<std::unique_ptr<RayScene>> build(
        const CityModel& city, std::span<const Occluder> occluders, const JobContext& job);
    /// The city of `city` with occluders standing in it. The BVH of the city is shared, not built
    /// again; occluders that `city` has itself are left out. city: not null.
    [[nodiscard]] static Result<std::unique_ptr<RayScene>> withOccluders(
        std::shared_ptr<const RayScene> city, std::span<const Occluder> occluders,
        const JobContext& job);
    ~RayScene();

    /// The nearest hit not beyond `distance`.
    [[nodiscard]] SceneHit intersect(const glm::vec3& origin, const glm::vec3& direction,
                                     float distance) const;
    /// The same for many rays, in packets of 16: order them so that 16 in a row are alike.
    void intersect(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                   float distance, std::span<SceneHit> hits) const;
    /// Ray parameters of the hits, +infinity for misses, and nothing else: as fast as Embree can,
    /// for other tracers to be measured by. t: as many as rays.
    void intersect(const RayBundle& rays, const RayPackets& packets, std::span<float> t) const;
    [[nodiscard]] bool occluded(const glm::vec3& origin, const glm::vec3& direction,
                                float distance) const;
    /// occluded[i] becomes 1 when something lies within distances[i] along ray i, else 0.
    void occluded(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                  std::span<const float> distances, std::span<unsigned char> occluded) const;
    /// Calls visit for each triangle of the city that the half-line crosses, in any order.
    void crossings(const glm::vec3& origin, const glm::vec3& direction,
                   const std::function<void(std::uint32_t triangle, float distance)>& visit) const;

private:
    struct Handles;
    explicit RayScene(std::unique_ptr<Handles> handles);
    std::unique_ptr<Handles> m_handles;
};

}  // namespace reflet
