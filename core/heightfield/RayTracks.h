// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/HeightfieldTracer.h"
#include "core/heightfield/TrackWalk.h"

#include <utility>
#include <vector>

namespace reflet {

/// Rays put together to tracks. Rays that never hit anything (a component that is not finite, no
/// direction) are left out. Keeps its memory from one use to the next.
class RayTracks {
public:
    /// A track for each ray; their numbers count from 0.
    void addSingle(std::span<const Ray> rays);
    /// Finds the rays of one origin that share their horizontal direction.
    void addGrouped(const glm::dvec3& origin, std::span<const glm::dvec3> directions);
    /// Lines [first, last) of a grid: of rows where the vertical component changes along them, of
    /// columns otherwise. A ray's number is its place in the grid.
    void addGrid(const glm::dvec3& origin, const DirectionGrid& directions, std::size_t first,
                 std::size_t last);
    void clear();

    /// What walkTracks() works on; valid until the next change. t, cell: by the rays' numbers.
    [[nodiscard]] TrackBatch batch(double* t, std::uint32_t* cell);

private:
    /// Rays that share a horizontal direction: how many, and where the next one goes.
    struct Group {
        double x = 0.0, y = 0.0;
        std::uint32_t next = 0, count = 0;
    };
    std::uint32_t groupOf(double x, double y);
    void addTrack(const glm::dvec3& origin, double x, double y, std::uint32_t first,
                  std::uint32_t last);
    void addGridSingly(const glm::dvec3& origin, const DirectionGrid& directions,
                       std::size_t firstColumn, std::size_t lastColumn);

    std::vector<Track> m_tracks;
    bool m_abreast = false;  ///< neighbouring tracks are alike, of one ray each
    std::vector<double> m_directionZ;
    std::vector<std::uint32_t> m_ray;
    std::vector<std::uint32_t> m_slot;  ///< hash table: 1 + a group's number, or 0
    std::vector<Group> m_groups;
    std::vector<std::uint32_t> m_groupOfRay;
    std::vector<std::pair<double, std::uint32_t>> m_line;  ///< of a grid: z, and where it lies
};

/// Whether a ray can hit anything at all.
[[nodiscard]] bool canHit(const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace reflet
