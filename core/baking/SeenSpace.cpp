// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/SeenSpace.h"

#include "core/baking/AmbientLight.h"
#include "core/base/HashMix.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRoom = 0.02;  ///< metres for rounding

/// Marks what lies within a distance of marked cells.
void addAround(const CellGrid& grid, const std::vector<std::atomic<unsigned char>>& from,
               double distance, std::vector<unsigned char>& to) {
    const double reach = distance / grid.size;
    const int most = int(reach) + 1;
    const auto gap = [](int cells) { return double(std::max(std::abs(cells) - 1, 0)); };
    glm::ivec3 cell;
    for (cell.z = 0; cell.z < grid.count.z; ++cell.z) {
        for (cell.y = 0; cell.y < grid.count.y; ++cell.y) {
            for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
                if (from[grid.index(cell)].load(std::memory_order_relaxed) == 0)
                    continue;
                const int top = std::min(cell.z + most, grid.count.z - 1);
                const int back = std::min(cell.y + most, grid.count.y - 1);
                for (int z = std::max(cell.z - most, 0); z <= top; ++z) {
                    for (int y = std::max(cell.y - most, 0); y <= back; ++y) {
                        const double left = reach * reach - gap(z - cell.z) * gap(z - cell.z) -
                                            gap(y - cell.y) * gap(y - cell.y);
                        if (left < 0.0)
                            continue;
                        const int half = int(std::sqrt(left)) + 1;
                        const int first = std::max(cell.x - half, 0);
                        const int last = std::min(cell.x + half, grid.count.x - 1);
                        std::fill_n(to.begin() + std::ptrdiff_t(grid.index({first, y, z})),
                                    last - first + 1, static_cast<unsigned char>(1));
                    }
                }
            }
        }
    }
}

/// Marks all that a cell passes when it moves towards the sun, up to the topmost layer.
void sweep(const CellGrid& grid, const glm::ivec3& from, const glm::dvec3& sun,
           std::vector<unsigned char>& to) {
    constexpr double kStep = 0.5;  // of a cell
    glm::dvec3 at(from);
    const glm::ivec3 last = grid.count - 1;
    while (at.z < double(last.z)) {
        const glm::dvec3 next = at + kStep * sun;
        const glm::ivec3 low = grid.clamped(glm::ivec3(glm::floor(glm::min(at, next))));
        glm::ivec3 high = grid.clamped(glm::ivec3(glm::floor(glm::max(at, next))) + 1);
        // Beyond the sides it only rises: all that is left of the way at once.
        const bool leaving = low.x == high.x && low.y == high.y;
        if (leaving)
            high.z = last.z;
        for (int z = low.z; z <= high.z; ++z) {
            for (int y = low.y; y <= high.y; ++y)
                std::fill_n(to.begin() + std::ptrdiff_t(grid.index({low.x, y, z})),
                            high.x - low.x + 1, static_cast<unsigned char>(1));
        }
        if (leaving)
            return;
        at = next;
    }
}

}  // namespace

bool SeenSpace::touches(const Box& box) const {
    if (box.empty())
        return false;
    const glm::ivec3 low = grid.cellAt(box.min), high = grid.cellAt(box.max);
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            const auto row = cells.begin() + std::ptrdiff_t(grid.index({low.x, y, z}));
            if (std::find(row, row + (high.x - low.x + 1), 1) != row + (high.x - low.x + 1))
                return true;
        }
    }
    return false;
}

std::uint64_t contentOf(const SeenSpace& space, const CellContents& contents) {
    std::uint64_t sum = mixed(contents.everywhere);
    for (std::size_t i = 0; i < space.cells.size(); ++i) {
        if (space.cells[i] != 0 && contents.cells[i] != 0)
            sum += joined(i, contents.cells[i]);
    }
    return sum;
}

SightRecorder::SightRecorder(const CellContents& contents, const glm::dvec3& center,
                             const Lighting& lighting)
    : m_contents(contents),
      m_center(glm::vec3(center)),  // rays start at what is left of it in float
      m_sun(lighting.sunDirection),
      m_day(Sky(lighting).sunRadiance().g > 0.0F),
      m_air(contents.grid.cells()),
      m_met(contents.grid.cells()) {}

void SightRecorder::add(std::span<const glm::vec3> directions, std::span<const SceneHit> hits) {
    const CellGrid& grid = m_contents.grid;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const glm::dvec3 direction(directions[i]);
        follow(direction, double(hits[i].distance));
        if (hits[i].triangle != kNone) {
            const glm::dvec3 met = m_center + double(hits[i].distance) * direction;
            m_met[grid.index(grid.cellAt(met))].store(1, std::memory_order_relaxed);
        }
    }
}

/// From cell to cell along a ray (Amanatides and Woo 1987). Out of an outermost cell there is no
/// way but along it.
void SightRecorder::follow(const glm::dvec3& direction, double distance) {
    const CellGrid& grid = m_contents.grid;
    const glm::dvec3 start = (m_center - grid.origin) / grid.size;
    glm::ivec3 cell = grid.cellAt(m_center);
    glm::ivec3 step;
    glm::dvec3 next, width;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = direction[axis] / grid.size;
        step[axis] = d > 0.0 ? 1 : -1;
        width[axis] = d != 0.0 ? 1.0 / std::abs(d) : kNever;
        const double border = double(cell[axis] + (d > 0.0 ? 1 : 0));
        next[axis] = d != 0.0 ? (border - start[axis]) / d : kNever;
    }
    const double end = distance + kRoom;
    for (;;) {
        std::atomic<unsigned char>& mark = m_air[grid.index(cell)];
        if (mark.load(std::memory_order_relaxed) == 0)
            mark.store(1, std::memory_order_relaxed);
        for (int axis = 0; axis < 3; ++axis) {
            const int beyond = cell[axis] + step[axis];
            if (beyond < 0 || beyond >= grid.count[axis])
                next[axis] = kNever;
        }
        const int axis = next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
        if (!(next[axis] <= end) || next[axis] == kNever)
            return;
        cell[axis] += step[axis];
        next[axis] += width[axis];
    }
}

SeenSpace SightRecorder::seen() const {
    const CellGrid& grid = m_contents.grid;
    SeenSpace space{grid, std::vector<unsigned char>(m_air.begin(), m_air.end())};
    // A point met may lie in the next cell by rounding: hence the room.
    addAround(grid, m_met, AmbientLight::reach() + kRoom, space.cells);
    if (!m_day)
        return space;
    if (m_sun.z <= 0.0) {  // no way up: from anywhere
        std::fill(space.cells.begin(), space.cells.end(), static_cast<unsigned char>(1));
        return space;
    }
    const std::vector<unsigned char> lit = space.cells;
    glm::ivec3 cell;
    for (cell.z = 0; cell.z < grid.count.z; ++cell.z) {
        for (cell.y = 0; cell.y < grid.count.y; ++cell.y) {
            for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
                const std::size_t i = grid.index(cell);
                if (cell.z == grid.count.z - 1)
                    space.cells[i] = 1;
                else if (lit[i] != 0 && (m_contents.cells[i] != 0 || m_contents.everywhere != 0))
                    sweep(grid, cell, m_sun, space.cells);
            }
        }
    }
    return space;
}

}  // namespace reflet
