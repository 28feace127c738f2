// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightfieldTracer.h"

#include "core/heightfield/GridWalk.h"

namespace reflet {

namespace {

/// Blocks of 64 x 64 cells, in them blocks of 8 x 8, in them cells: three nested grid walks cost
/// less than a climb through all levels, because each step is as cheap as the plain walk's.
constexpr int kTopLevel = 3;
constexpr int kLevelStep = 3;

/// Columns that are solid up to their heights: a field without spans is traced as fast as it can.
struct PlainColumns {
    static double meets(const HeightWalk& z, std::size_t, double height, double t, double leave) {
        return z.meets(height, t, leave);
    }
};

/// Columns of which some are hollow somewhere.
struct SpannedColumns {
    const CellSpans* spans;

    [[nodiscard]] double meets(const HeightWalk& z, std::size_t cell, double height, double t,
                               double leave) const {
        const auto column = spans->at(cell);
        return column.empty() ? z.meets(height, t, leave) : z.meets(column, t, leave);
    }
};

/// One ray's walk over the pyramid. A block is entered only if the plain walk could find something
/// in it, so the first hit is the plain walk's, bit for bit:
///
/// - A rising ray is lowest where it enters a block, and z is monotone in t after rounding too, so
///   z(enter) > maximum rules out all of its cells.
/// - A falling ray is lowest where it leaves. HeightWalk::meets asks there by
///   (h - o)·(1/d) < leave as well, which agrees with o + leave·d <= h but for a few roundings: the
///   margin, several times their sum, covers them.
template <bool falls, class Columns>
class PyramidWalk {
public:
    PyramidWalk(const MaxPyramid& pyramid, Columns columns, const GridWalk& walk, double margin)
        : m_pyramid(pyramid), m_columns(columns), m_walk(walk), m_margin(margin) {}

    /// Goes through the blocks of one level from time t, up to `until`.
    template <int level>
    bool through(double t, double until) {
        const MaxPyramid::Level& blocks =
            m_pyramid.levels[std::min<std::size_t>(level, m_pyramid.levels.size() - 1)];
        const AxisWalk& x = m_walk.x;
        const AxisWalk& y = m_walk.y;
        int i = x.cellAt(t) >> level;
        int j = y.cellAt(t) >> level;
        double leaveX = x.leaveBlock(i, level);
        double leaveY = y.leaveBlock(j, level);
        while (t < until) {
            const double leave = std::min(leaveX, leaveY);
            const std::size_t block = std::size_t(j) * std::size_t(blocks.columns) + std::size_t(i);
            const double maximum = double(blocks.maximum[block]);
            const double lowest = m_walk.z.at(falls ? leave : t);
            if (!(lowest > maximum + m_margin) && t < leave) {
                if constexpr (level > 0) {
                    if (through<level - kLevelStep>(t, std::min(leave, until))) {
                        return true;
                    }
                } else if (meets(block, maximum, t, leave)) {
                    m_hit.i = i;
                    m_hit.j = j;
                    return true;
                }
            }
            t = leave;
            // Without branches: which border comes first is a coin toss.
            i += leaveX <= leave ? x.step() : 0;
            j += leaveY <= leave ? y.step() : 0;
            leaveX = x.leaveBlock(i, level);
            leaveY = y.leaveBlock(j, level);
        }
        return false;
    }

    [[nodiscard]] const HeightfieldHit& hit() const { return m_hit; }

private:
    bool meets(std::size_t cell, double height, double t, double leave) {
        m_hit.t = m_columns.meets(m_walk.z, cell, height, t, leave);
        m_hit.hit = std::isfinite(m_hit.t);
        return m_hit.hit;
    }

    const MaxPyramid& m_pyramid;
    [[no_unique_address]] Columns m_columns;
    const GridWalk& m_walk;
    double m_margin;
    HeightfieldHit m_hit;
};

template <bool falls, class Columns>
HeightfieldHit traceBlocks(const MaxPyramid& pyramid, Columns columns, const GridWalk& walk,
                           double margin, double from, double until) {
    if (!(from < until)) {
        return {};
    }
    PyramidWalk<falls, Columns> blocks(pyramid, columns, walk, margin);
    return blocks.template through<kTopLevel>(from, until) ? blocks.hit() : HeightfieldHit{};
}

template <class Columns>
HeightfieldHit traceColumns(const MaxPyramid& pyramid, Columns columns, const Ray& ray,
                            double highest, double magnitude) {
    const GridWalk walk(pyramid.grid, ray);
    const double margin = 1e-14 * (1.0 + std::abs(ray.origin.z) + magnitude);
    // Above the highest column nothing is hit: begin where a falling ray comes down to it, end
    // where a rising one has passed it.
    const double crossing = walk.z.timeAt(highest + margin);
    if (ray.direction.z < 0.0) {
        return traceBlocks<true>(pyramid, columns, walk, margin, std::max(walk.enter, crossing),
                                 walk.leave);
    }
    const double until = ray.direction.z > 0.0 ? std::min(walk.leave, crossing) : walk.leave;
    return traceBlocks<false>(pyramid, columns, walk, margin, walk.enter, until);
}

/// Apart, so that the walk over plain columns stays whole in its caller: 4 % of its time.
[[gnu::noinline]] HeightfieldHit traceSpanned(const MaxPyramid& pyramid, const CellSpans& spans,
                                              const Ray& ray, double highest, double magnitude) {
    return traceColumns(pyramid, SpannedColumns{&spans}, ray, highest, magnitude);
}

/// The heights where the columns end: the layer's, but for spans that are not in it.
std::vector<float> columnTops(const std::vector<float>& layer, const CellSpans& spans) {
    std::vector<float> tops = layer;
    for (const std::uint32_t cell : spans.cells()) {
        tops[cell] = spans.at(cell).back().high;
    }
    return tops;
}

}  // namespace

HeightfieldTracer::HeightfieldTracer(const Heightfield& field, TopLayer layer)
    : m_spans(layer == TopLayer::Maximum ? field.spans : field.centerSpans) {
    m_pyramid = buildMaxPyramid(
        field.grid,
        columnTops(layer == TopLayer::Maximum ? field.topMax : field.topCenter, m_spans));
    m_tiled = tiledHeights(field.grid, m_pyramid.levels.front().maximum);
    const MaxPyramid::Level& top = m_pyramid.levels.back();
    m_highest = top.maximum.empty() ? -double(kInfinity) : double(top.maximum.front());
    for (const float height : m_pyramid.levels.front().maximum) {
        if (std::isfinite(height)) {
            m_magnitude = std::max(m_magnitude, std::abs(double(height)));
        }
    }
}

HeightfieldHit HeightfieldTracer::trace(const Ray& ray) const {
    if (!m_spans.empty())
        return traceSpanned(m_pyramid, m_spans, ray, m_highest, m_magnitude);
    return traceColumns(m_pyramid, PlainColumns(), ray, m_highest, m_magnitude);
}

}  // namespace reflet
