// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/Hiding.h"

#include "core/base/ParallelFor.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();
constexpr int kMostWedges = 256;
/// Metres that heights may be off by rounding.
constexpr double kSlack = 0.01;

std::array<glm::dvec2, 4> planCorners(const Box& box) {
    return {{{box.min.x, box.min.y},
             {box.max.x, box.min.y},
             {box.max.x, box.max.y},
             {box.min.x, box.max.y}}};
}

/// Metres in the plan from a point to the nearest of a box; 0 within.
double planDistance(const glm::dvec2& from, const Box& box) {
    const glm::dvec2 nearest = glm::clamp(from, glm::dvec2(box.min), glm::dvec2(box.max));
    return glm::distance(from, nearest);
}

float lowestAround(const Heightfield& field, int i, int j) {
    const GridSpec& grid = field.grid;
    float lowest = std::numeric_limits<float>::infinity();
    for (int dj = -1; dj <= 1; ++dj) {
        for (int di = -1; di <= 1; ++di) {
            if (!grid.contains(i + di, j + dj))
                return kNothing;
            const float top = field.standingTop(grid.index(i + di, j + dj));
            if (isMissing(top))
                return kNothing;
            lowest = std::min(lowest, top);
        }
    }
    return lowest;
}

}  // namespace

Hiding::Hiding(const Heightfield& field)
    : m_grid(field.grid), m_solid(field.grid.cellCount(), kNothing) {
    parallelFor(0, std::size_t(std::max(m_grid.rows, 0)), 16,
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t j = first; j < last; ++j) {
                        for (int i = 0; i < m_grid.columns; ++i)
                            m_solid[m_grid.index(i, int(j))] = lowestAround(field, i, int(j));
                    }
                });
    const auto most = std::max_element(m_solid.begin(), m_solid.end());
    m_highest = most == m_solid.end() ? double(kNothing) : double(*most);
}

double Hiding::lowest(const glm::dvec2& min, const glm::dvec2& max) const {
    const Cells cells = touched(min, max);
    if (!m_grid.contains(cells.i0, cells.j0) || !m_grid.contains(cells.i1, cells.j1))
        return double(kNothing);
    float lowest = std::numeric_limits<float>::infinity();
    for (int j = cells.j0; j <= cells.j1; ++j) {
        for (int i = cells.i0; i <= cells.i1; ++i)
            lowest = std::min(lowest, m_solid[m_grid.index(i, j)]);
    }
    return double(lowest);
}

double Hiding::highest(const glm::dvec2& min, const glm::dvec2& max) const {
    const Cells cells = touched(min, max);
    float highest = kNothing;
    for (int j = cells.j0; j <= cells.j1; ++j) {
        for (int i = cells.i0; i <= cells.i1; ++i) {
            if (m_grid.contains(i, j))
                highest = std::max(highest, m_solid[m_grid.index(i, j)]);
        }
    }
    return double(highest);
}

Hiding::Cells Hiding::touched(const glm::dvec2& min, const glm::dvec2& max) const {
    // Far outside the grid all is the same.
    const glm::dvec2 low(m_grid.xMin(-2), m_grid.yMin(-2));
    const glm::dvec2 high(m_grid.xMax() + 2.0 * m_grid.cellSize,
                          m_grid.yMax() + 2.0 * m_grid.cellSize);
    const glm::dvec2 from = glm::clamp(min, low, high), to = glm::clamp(max, low, high);
    return {m_grid.column(from.x), m_grid.row(from.y), m_grid.column(to.x), m_grid.row(to.y)};
}

/// Somewhere along the wedge its whole width lies in columns that reach above the steepest line of
/// sight: lines below it enter them, too, if they have not met the ground before.
bool Hiding::blocked(const glm::dvec3& eye, const Wedge& wedge) const {
    const glm::dvec2 from(eye);
    const double step = m_grid.cellSize;
    const double nearer =
        0.5 * glm::length(wedge.left + wedge.right);  // of the middle of its width
    for (double run = step; run < wedge.reach; run += step) {
        const double line = eye.z + wedge.slope * run * (wedge.slope < 0.0 ? nearer : 1.0) + kSlack;
        if (wedge.slope >= 0.0 && line > m_highest)
            return false;
        const glm::dvec2 a = from + run * wedge.left;
        const glm::dvec2 b = from + run * wedge.right;
        if (lowest(glm::min(a, b), glm::max(a, b)) >= line)
            return true;
    }
    return false;
}

bool Hiding::hides(const glm::dvec3& eye, const Box& box) const {
    if (box.empty())
        return true;
    const glm::dvec2 from(eye);
    const double nearest = planDistance(from, box);
    if (!(nearest > m_grid.cellSize) || !std::isfinite(nearest))
        return false;
    const glm::dvec2 cell(m_grid.cellSize);
    if (highest(from - cell, from + cell) >= eye.z)
        return false;  // within a building there is no telling what is seen
    double farthest = 0.0;
    const glm::dvec2 axis = glm::normalize(glm::dvec2(box.center()) - from);
    const glm::dvec2 across(-axis.y, axis.x);
    double least = 0.0, most = 0.0;  // tangents of the angles to both sides of the axis
    for (const glm::dvec2& corner : planCorners(box)) {
        const glm::dvec2 to = corner - from;
        farthest = std::max(farthest, glm::length(to));
        const double ahead = glm::dot(to, axis);
        if (!(ahead > 0.0))
            return false;
        least = std::min(least, glm::dot(to, across) / ahead);
        most = std::max(most, glm::dot(to, across) / ahead);
    }
    const double rise = box.max.z - eye.z;
    const double slope = rise / (rise > 0.0 ? nearest : farthest);
    // As narrow as a cell at the far end, so that a wedge touches few columns.
    const double width = (most - least) * farthest;
    const int count = std::clamp(int(std::ceil(width / m_grid.cellSize)), 1, kMostWedges);
    for (int k = 0; k < count; ++k) {
        const auto edge = [&](int n) {
            return glm::normalize(axis + (least + (most - least) * n / count) * across);
        };
        if (!blocked(eye, {edge(k), edge(k + 1), slope, nearest}))
            return false;
    }
    return true;
}

}  // namespace reflet
