// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {

/// One axis of a ray's way over a grid: the one place where ray parameters of cell borders are
/// computed, so that every walk sees the same doubles.
///
/// Border k lies at b(k) = x0 + k·s and is passed at t(k) = (b(k) - o)·(1/d). Each operation is
/// monotone in k after rounding too, so the half-open spans [enter(k), leave(k)) of the cells cut
/// the time line without gap or overlap, in floating point as in theory.
class AxisWalk {
public:
    AxisWalk(double gridOrigin, double cellSize, int count, double origin, double direction)
        : m_gridOrigin(gridOrigin),
          m_cellSize(cellSize),
          m_perCell(1.0 / cellSize),
          m_origin(origin),
          m_direction(direction),
          m_inverse(1.0 / direction),
          m_count(count) {
        // A component whose reciprocal overflows passes no border in any finite time.
        if (std::isinf(m_inverse)) {
            m_direction = 0.0;
        }
    }

    [[nodiscard]] double border(int k) const { return m_gridOrigin + k * m_cellSize; }
    [[nodiscard]] double time(int k) const { return (border(k) - m_origin) * m_inverse; }
    [[nodiscard]] bool parallel() const { return m_direction == 0.0; }
    /// +1 or -1: the way in which cells follow one another. Not for a parallel ray.
    [[nodiscard]] int step() const { return m_direction > 0.0 ? 1 : -1; }
    [[nodiscard]] int count() const { return m_count; }

    /// When the ray enters the cells [first, last): t of the border on its side.
    [[nodiscard]] double enter(int first, int last) const {
        if (parallel()) {
            return inside(first, last) ? -kForever : kForever;
        }
        return time(m_direction > 0.0 ? first : last);
    }
    /// When it leaves them; never for a parallel ray between their borders.
    [[nodiscard]] double leave(int first, int last) const {
        if (parallel()) {
            return inside(first, last) ? kForever : -kForever;
        }
        return time(m_direction > 0.0 ? last : first);
    }

    /// The one cell with enter <= t < leave; -1 or count when that lies outside the grid. A guess
    /// from the position is set right by the borders' own times, so rounding cannot choose.
    [[nodiscard]] int cellAt(double t) const {
        const double position = parallel() ? m_origin : m_origin + t * m_direction;
        const double guess = std::floor((position - m_gridOrigin) * m_perCell);
        int k = guess >= 0.0 ? (guess < m_count ? int(guess) : m_count - 1) : 0;
        if (parallel()) {
            while (k >= 0 && m_origin < border(k))
                --k;
            while (k < m_count && k >= 0 && m_origin >= border(k + 1))
                ++k;
        } else if (m_direction > 0.0) {
            while (k >= 0 && t < time(k))
                --k;
            while (k < m_count && k >= 0 && t >= time(k + 1))
                ++k;
        } else {
            while (k >= 0 && t >= time(k))
                --k;
            while (k < m_count && k >= 0 && t < time(k + 1))
                ++k;
        }
        return k;
    }

private:
    static constexpr double kForever = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool inside(int first, int last) const {
        return m_origin >= border(first) && m_origin < border(last);
    }

    double m_gridOrigin;
    double m_cellSize;
    double m_perCell;
    double m_origin;
    double m_direction;
    double m_inverse;
    int m_count;
};

/// The height of a ray over time, and its meeting with one column.
class HeightWalk {
public:
    HeightWalk(double origin, double direction)
        : m_origin(origin), m_direction(direction), m_inverse(1.0 / direction) {}

    [[nodiscard]] double at(double t) const { return m_origin + t * m_direction; }
    [[nodiscard]] bool falls() const { return m_direction < 0.0; }
    [[nodiscard]] double timeAt(double height) const { return (height - m_origin) * m_inverse; }

    /// First t in [enter, leave) with the ray at or below `height`: at once through the wall, or
    /// later through the top; infinity if it passes over.
    [[nodiscard]] double meets(double height, double enter, double leave) const {
        if (at(enter) <= height) {
            return enter;
        }
        if (falls()) {
            const double t = timeAt(height);
            if (t < leave) {
                return t > enter ? t : enter;
            }
        }
        return std::numeric_limits<double>::infinity();
    }

private:
    double m_origin;
    double m_direction;
    double m_inverse;
};

/// A ray over a grid: its two axes, its height, and the span of time above the grid.
struct GridWalk {
    AxisWalk x;
    AxisWalk y;
    HeightWalk z;
    double enter = 0.0;  ///< max(0, entry into the grid)
    double leave = 0.0;  ///< exit; the ray misses the grid unless enter < leave

    GridWalk(const GridSpec& grid, const Ray& ray)
        : x(grid.x0, grid.cellSize, grid.columns, ray.origin.x, ray.direction.x),
          y(grid.y0, grid.cellSize, grid.rows, ray.origin.y, ray.direction.y),
          z(ray.origin.z, ray.direction.z) {
        // 0·inf and 0·NaN are NaN: rays with such components miss.
        const glm::dvec3 zero = 0.0 * (ray.origin + ray.direction);
        if (zero == glm::dvec3(0.0) && ray.direction != glm::dvec3(0.0)) {
            enter = std::max({0.0, x.enter(0, grid.columns), y.enter(0, grid.rows)});
            leave = std::min(x.leave(0, grid.columns), y.leave(0, grid.rows));
        }
    }
};

}  // namespace reflet
