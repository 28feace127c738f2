// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/CityContents.h"
#include "core/baking/Lighting.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace reflet {

/// The part of space that a baked map depends on: as long as nothing in it changes, baking again
/// gives the same map.
struct SeenSpace {
    CellGrid grid;
    std::vector<unsigned char> cells;  ///< by CellGrid::index; 1 = depended on

    [[nodiscard]] bool touches(const Box& box) const;
};

/// The number that stands for what a city shows there. contents: in the grid of `space`.
[[nodiscard]] std::uint64_t contentOf(const SeenSpace& space, const CellContents& contents);

/// Watches the rays of a map while it is baked and tells what it depends on, by whole cells:
/// - the air along each ray up to what it meets, or on and on: whatever were put there hides that;
/// - all within AmbientLight::reach() of a point met: its soft light is gathered from there, and
///   the texels' looks with it;
/// - by day, the way to the sun from all surfaces in those two: what stands there throws shadow on
///   the point itself, or on what throws light on it; and all higher than the city.
class SightRecorder {
public:
    /// contents: of the city that is baked, and must outlive this. center: of the map.
    SightRecorder(const CellContents& contents, const glm::dvec3& center, const Lighting& lighting);
    /// Any thread. As many hits as directions (unit).
    void add(std::span<const glm::vec3> directions, std::span<const SceneHit> hits);
    /// After the last ray.
    [[nodiscard]] SeenSpace seen() const;

private:
    using Cells = std::vector<std::atomic<unsigned char>>;
    void follow(const glm::dvec3& direction, double distance);

    const CellContents& m_contents;
    glm::dvec3 m_center;
    glm::dvec3 m_sun;
    bool m_day;
    Cells m_air, m_met;
};

}  // namespace reflet
