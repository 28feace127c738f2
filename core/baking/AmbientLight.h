// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/LightGatherer.h"

#include <atomic>
#include <memory>

namespace reflet {

/// Ambient light on the surfaces of a city, kept: computed at the points of a lattice of half a
/// metre in each surface's plane (coarser, by powers of two, for samples that see more than an
/// eighth of a metre; once for triangles smaller than a metre) and interpolated. A cache
/// that any thread may fill holds what was computed; an entry depends on its key alone, so that
/// results do not depend on who filled it, or when.
class AmbientLight {
public:
    /// All must outlive this.
    AmbientLight(const CityModel& city, const RayScene& scene, const SurfaceLooks& looks,
                 const LightGatherer& gatherer);
    ~AmbientLight();

    /// Irradiance / pi at a point of a triangle; normal: unit, towards the viewer.
    /// footprint: what the sample sees, metres across.
    [[nodiscard]] glm::vec3 at(std::uint32_t triangle, const glm::vec3& point,
                               const glm::vec3& normal, float footprint) const;
    /// Metres around a point within which lies all that its light is gathered from; the sun shines
    /// on that from wherever it does.
    [[nodiscard]] static double reach();

private:
    struct Lattice;
    /// Pairs of (key xor value, value): a torn pair is seen as a miss, without locks (R. Hyatt, A
    /// lock-less transposition table, 2002).
    struct Slot {
        std::atomic<std::uint64_t> check{0};
        std::atomic<std::uint64_t> value{0};
    };

    [[nodiscard]] Lattice latticeOf(std::uint32_t triangle, const glm::vec3& normal) const;
    [[nodiscard]] glm::vec3 interpolate(const Lattice& lattice, const glm::vec3& point,
                                        int level) const;
    [[nodiscard]] LightGatherer::Light cached(std::uint64_t key, const glm::vec3& point,
                                              const glm::vec3& normal,
                                              LightGatherer::Effort effort) const;
    [[nodiscard]] bool separated(const glm::vec3& a, const glm::vec3& b,
                                 const glm::vec3& normal) const;

    const CityModel& m_city;
    const RayScene& m_scene;
    const SurfaceLooks& m_looks;
    const LightGatherer& m_gatherer;
    std::unique_ptr<Slot[]> m_slots;
};

}  // namespace reflet
