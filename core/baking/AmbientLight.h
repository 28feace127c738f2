// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/CityAppearance.h"
#include "core/baking/RayScene.h"

#include <atomic>
#include <memory>
#include <vector>

namespace reflet {

/// Light from everywhere but the sun: the sky where it is seen, and one bounce where something
/// stands in the way. A function of the surface point and its normal alone, free of noise: a fixed
/// set of cosine-distributed directions, occlusion that fades out between 12 and 25 m.
///
/// On the city's surfaces it is computed at the points of a lattice of half a metre in each
/// surface's plane (once for triangles smaller than that) and interpolated; a cache that any thread
/// may fill keeps what was computed. An entry depends on its key alone, so that results do not
/// depend on who filled it, or when.
class AmbientLight {
public:
    AmbientLight(const CityModel& city, const RayScene& scene, const CityAppearance& appearance,
                 const Sky& sky);
    ~AmbientLight();

    /// Irradiance / pi at a point of a triangle of the city; normal: unit, towards the viewer.
    [[nodiscard]] glm::vec3 onCity(std::uint32_t triangle, const glm::vec3& point,
                                   const glm::vec3& normal) const;
    /// Irradiance / pi at any point and normal, computed anew.
    [[nodiscard]] glm::vec3 at(const glm::vec3& point, const glm::vec3& normal) const;

private:
    struct Sample {
        glm::vec3 light{0.0F};
        bool confined = false;  ///< something is so near that a neighbour may lie behind it
    };
    struct Lattice;

    [[nodiscard]] Sample gather(const glm::vec3& point, const glm::vec3& normal) const;
    [[nodiscard]] Sample cached(std::uint64_t key, const glm::vec3& point,
                                const glm::vec3& normal) const;
    [[nodiscard]] glm::vec3 skyLight(const glm::vec3& direction) const;
    [[nodiscard]] glm::vec3 interpolate(const Lattice& lattice, const glm::vec3& point,
                                        const glm::vec3& normal) const;

    const CityModel& m_city;
    const RayScene& m_scene;
    const CityAppearance& m_appearance;
    const Sky& m_sky;
    std::vector<glm::vec3> m_skyTable;  ///< radiance by azimuth and z
    /// Pairs of (key xor value, value): a torn pair is seen as a miss, without locks (R. Hyatt, A
    /// lock-less transposition table, 2002).
    struct Slot {
        std::atomic<std::uint64_t> check{0};
        std::atomic<std::uint64_t> value{0};
    };
    std::unique_ptr<Slot[]> m_slots;
};

}  // namespace reflet
