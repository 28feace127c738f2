// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightfieldTracer.h"

#include "core/heightfield/GridWalk.h"

namespace reflet {

namespace {

/// A square block of the pyramid as a ray sees it: the cells [first, last) of each axis.
struct BlockSpan {
    int first;
    int last;
};

BlockSpan blockOf(int cell, int level, int count) {
    const int first = (cell >> level) << level;
    return {first, std::min(first + (1 << level), count)};
}

/// The cell of one axis after the ray has crossed a block at time t.
int cellAfter(const AxisWalk& axis, BlockSpan block, double leaveAxis, double t, int level,
              int cell) {
    if (leaveAxis <= t) {
        return axis.step() > 0 ? block.last : block.first - 1;
    }
    return level == 0 ? cell : axis.cellAt(t);
}

}  // namespace

HeightfieldTracer::HeightfieldTracer(const Heightfield& field, TopLayer layer)
    : m_pyramid(buildMaxPyramid(field.grid,
                                layer == TopLayer::Maximum ? field.topMax : field.topCenter)) {
    const MaxPyramid::Level& top = m_pyramid.levels.back();
    m_highest = top.maximum.empty() ? -double(kInfinity) : double(top.maximum.front());
    for (const float height : m_pyramid.levels.front().maximum) {
        if (std::isfinite(height)) {
            m_magnitude = std::max(m_magnitude, std::abs(double(height)));
        }
    }
}

HeightfieldHit HeightfieldTracer::trace(const Ray& ray) const {
    const GridSpec& grid = m_pyramid.grid;
    const GridWalk walk(grid, ray);
    if (!(walk.enter < walk.leave)) {
        return {};
    }
    // A block may be passed over only if the walk through its cells would find nothing. A rising
    // ray is lowest where it enters, and z is monotone in t after rounding too, so the plain
    // comparison does. A falling ray is lowest where it leaves; HeightWalk::meets asks there by
    // (h - o)·(1/d) < leave as well, which agrees with o + leave·d > h but for a few roundings:
    // the margin, twenty times their sum, covers them.
    const double margin = walk.z.falls() ? 1e-14 * (std::abs(ray.origin.z) + m_magnitude) : 0.0;
    const int topLevel = int(m_pyramid.levels.size()) - 1;
    double t = walk.enter;
    int i = walk.x.cellAt(t);
    int j = walk.y.cellAt(t);
    int level = 0;
    while (grid.contains(i, j)) {
        const BlockSpan columns = blockOf(i, level, grid.columns);
        const BlockSpan rows = blockOf(j, level, grid.rows);
        const double leaveX = walk.x.leave(columns.first, columns.last);
        const double leaveY = walk.y.leave(rows.first, rows.last);
        const double leave = std::min(leaveX, leaveY);
        const MaxPyramid::Level& blocks = m_pyramid.levels[std::size_t(level)];
        const double height =
            double(blocks.maximum[std::size_t(j >> level) * std::size_t(blocks.columns) +
                                  std::size_t(i >> level)]);
        const double lowest = walk.z.at(walk.z.falls() ? leave : t);
        if (!(lowest > height + margin)) {
            if (level > 0) {
                --level;
                continue;
            }
            const double tHit = t < leave ? walk.z.meets(height, t, leave) : double(kInfinity);
            if (std::isfinite(tHit)) {
                return {true, tHit, i, j};
            }
        }
        if (!std::isfinite(leave)) {
            break;
        }
        if (!walk.z.falls() && walk.z.at(leave) > m_highest) {
            break;
        }
        t = leave;
        i = cellAfter(walk.x, columns, leaveX, t, level, i);
        j = cellAfter(walk.y, rows, leaveY, t, level, j);
        level = std::min(level + 1, topLevel);
    }
    return {};
}

}  // namespace reflet
