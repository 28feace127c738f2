// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/Heightfield.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

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
          m_timeOrigin(gridOrigin),
          m_cellSize(cellSize),
          m_origin(origin),
          m_direction(direction),
          m_inverse(1.0 / direction),
          m_count(count),
          m_ahead(direction > 0.0 ? 1 : 0) {
        // A component whose reciprocal overflows passes no border in any finite time.
        if (std::isinf(m_inverse)) {
            m_direction = 0.0;
            m_inverse = 1.0;
            m_timeOrigin = kForever;
        }
    }

    [[nodiscard]] double border(int k) const { return m_gridOrigin + k * m_cellSize; }
    /// When border k is passed; never, for a parallel ray.
    [[nodiscard]] double time(int k) const {
        return (m_timeOrigin + k * m_cellSize - m_origin) * m_inverse;
    }
    [[nodiscard]] bool parallel() const { return m_direction == 0.0; }
    /// +1 or -1: the way in which cells follow one another. Any, for a parallel ray.
    [[nodiscard]] int step() const { return 2 * m_ahead - 1; }

    /// When the ray enters the grid; never for a parallel ray beside it.
    [[nodiscard]] double enterGrid() const {
        if (parallel()) {
            return besideGrid() ? kForever : -kForever;
        }
        return time(m_ahead != 0 ? 0 : m_count);
    }
    [[nodiscard]] double leaveGrid() const { return time(m_ahead != 0 ? m_count : 0); }

    /// When it leaves block b of 2^level cells, the last block cut off at the grid's end.
    [[nodiscard]] double leaveBlock(int b, int level) const {
        return time(std::min((b + m_ahead) << level, m_count));
    }
    [[nodiscard]] double leaveCell(int k) const { return time(k + m_ahead); }

    /// The one cell with enter <= t < leave; -1 or count when that lies outside the grid. A guess
    /// from the position is set right by the borders' own times, so rounding cannot choose.
    [[nodiscard]] int cellAt(double t) const {
        const double position = parallel() ? m_origin : m_origin + t * m_direction;
        const double guess = (position - m_gridOrigin) / m_cellSize;
        int k = guess >= 0.0 ? (guess < m_count ? int(guess) : m_count - 1) : 0;
        while (k >= 0 && beforeCell(k, t)) {
            --k;
        }
        while (k >= 0 && k < m_count && behindCell(k, t)) {
            ++k;
        }
        return k;
    }

private:
    static constexpr double kForever = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool besideGrid() const {
        return m_origin < border(0) || m_origin >= border(m_count);
    }
    /// Whether the ray is on the lower side of cell k at time t, by the rule of half-open spans.
    [[nodiscard]] bool beforeCell(int k, double t) const {
        if (parallel()) {
            return m_origin < border(k);
        }
        return m_ahead != 0 ? t < time(k) : t >= time(k);
    }
    [[nodiscard]] bool behindCell(int k, double t) const {
        if (parallel()) {
            return m_origin >= border(k + 1);
        }
        return m_ahead != 0 ? t >= time(k + 1) : t < time(k + 1);
    }

    double m_gridOrigin;
    double m_timeOrigin;
    double m_cellSize;
    double m_origin;
    double m_direction;
    double m_inverse;
    int m_count;
    int m_ahead;  ///< 1 when the ray goes up the axis, else 0
};

/// The height of a ray over time, and its meeting with one column.
class HeightWalk {
public:
    HeightWalk(double origin, double direction)
        : m_origin(origin), m_direction(direction), m_inverse(1.0 / direction) {}

    [[nodiscard]] double at(double t) const { return m_origin + t * m_direction; }
    [[nodiscard]] bool falls() const { return m_direction < 0.0; }
    [[nodiscard]] bool rises() const { return m_direction > 0.0; }
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

    /// The same for a column of several solid stretches, the lowest of which reaches down to
    /// -infinity: at once inside of one, else through the top of the one below the ray or the
    /// underside of the one above it.
    [[nodiscard]] double meets(std::span<const HeightSpan> column, double enter,
                               double leave) const {
        const double z = at(enter);
        std::size_t above = 0;
        while (above < column.size() && double(column[above].high) < z) {
            ++above;
        }
        if (above < column.size() && z >= double(column[above].low)) {
            return enter;
        }
        if (above > 0 && falls()) {
            return meets(double(column[above - 1].high), enter, leave);
        }
        if (above < column.size() && rises()) {
            const double t = timeAt(double(column[above].low));
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
            enter = std::max({0.0, x.enterGrid(), y.enterGrid()});
            leave = std::min(x.leaveGrid(), y.leaveGrid());
        }
    }
};

}  // namespace reflet
