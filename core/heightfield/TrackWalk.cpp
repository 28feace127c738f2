// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TrackWalk.h"

#include "core/heightfield/GridWalk.h"

#include <array>
#include <cstddef>
#include <limits>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/heightfield/TrackWalk.cpp"
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace reflet::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

constexpr std::size_t kMostLanes = 8;
constexpr std::size_t kPrepared = 64;  ///< tracks that are made ready at a time
constexpr double kForever = std::numeric_limits<double>::infinity();

V set(double value) {
    return hn::Set(D(), value);
}

/// As std::min and std::max of the walk of a single ray choose, signs of zero and NaN included.
V smaller(V a, V b) {
    return hn::IfThenElse(hn::Lt(b, a), b, a);
}
V larger(V a, V b) {
    return hn::IfThenElse(hn::Lt(a, b), b, a);
}

/// One axis of the walks of several tracks: AxisWalk, a lane each. A parallel axis passes no border
/// (timeOrigin is infinite), and is told by `direction` 0; its borders are compared with its origin
/// as if that were a time.
template <std::size_t n>
struct Axis {
    alignas(64) double timeOrigin[n];
    alignas(64) double origin[n];     ///< 0 for a parallel axis
    alignas(64) double inverse[n];    ///< 1 for a parallel axis
    alignas(64) double ahead[n];      ///< 1 up the axis, 0 down
    alignas(64) double step[n];       ///< 1 or -1
    alignas(64) double start[n];      ///< the origin, of a parallel axis too
    alignas(64) double direction[n];  ///< 0 for a parallel axis
};

/// Where several tracks are. Cells and blocks are counted in doubles, which holds them exactly.
template <std::size_t n>
struct Walks {
    Axis<n> x, y;
    alignas(64) double t[n];
    alignas(64) double i[n];  ///< block of `size` cells
    alignas(64) double j[n];
    alignas(64) double size[n];    ///< 64, 8 or 1
    alignas(64) double offset[n];  ///< block (i, j) lies at offset + j·stride + i
    alignas(64) double stride[n];
    alignas(64) double until[n];   ///< no ray of the track hits from here on
    alignas(64) double leave8[n];  ///< when the block of 8 x 8 around is left; never, if not inside
    alignas(64) double leave64[n];
    alignas(64) double offset8[n];  ///< offset for the blocks of 8 x 8
    alignas(64) double originZ[n];
    alignas(64) double directionZ[n];  ///< of the lowest ray that has not met anything
    alignas(64) double margin[n];
    std::uint32_t next[n];  ///< that ray
    std::uint32_t last[n];
};

template <std::size_t n>
HWY_INLINE void copyAxis(Axis<n>& to, std::size_t lane, const Axis<kPrepared>& from,
                         std::size_t k) {
    to.timeOrigin[lane] = from.timeOrigin[k];
    to.origin[lane] = from.origin[k];
    to.inverse[lane] = from.inverse[k];
    to.ahead[lane] = from.ahead[k];
    to.step[lane] = from.step[k];
    to.start[lane] = from.start[k];
    to.direction[lane] = from.direction[k];
}

template <std::size_t n>
HWY_INLINE void copyWalk(Walks<n>& to, std::size_t lane, const Walks<kPrepared>& from,
                         std::size_t k) {
    copyAxis(to.x, lane, from.x, k);
    copyAxis(to.y, lane, from.y, k);
    to.t[lane] = from.t[k];
    to.i[lane] = from.i[k];
    to.j[lane] = from.j[k];
    to.size[lane] = from.size[k];
    to.offset[lane] = from.offset[k];
    to.stride[lane] = from.stride[k];
    to.until[lane] = from.until[k];
    to.leave8[lane] = from.leave8[k];
    to.leave64[lane] = from.leave64[k];
    to.offset8[lane] = from.offset8[k];
    to.originZ[lane] = from.originZ[k];
    to.directionZ[lane] = from.directionZ[k];
    to.margin[lane] = from.margin[k];
    to.next[lane] = from.next[k];
    to.last[lane] = from.last[k];
}

/// An axis in registers.
struct AxisLanes {
    V timeOrigin, origin, inverse, ahead;

    template <std::size_t n>
    AxisLanes(const Axis<n>& axis, std::size_t k)
        : timeOrigin(hn::Load(D(), axis.timeOrigin + k)),
          origin(hn::Load(D(), axis.origin + k)),
          inverse(hn::Load(D(), axis.inverse + k)),
          ahead(hn::Load(D(), axis.ahead + k)) {}

    /// AxisWalk::time() with another zero.
    [[nodiscard]] V time(V zero, V border, V cellSize) const {
        return hn::Mul(hn::Sub(hn::Add(zero, hn::Mul(border, cellSize)), origin), inverse);
    }
};

/// One extent of the grid.
struct Extent {
    double zero;
    double cellSize;
    double count;
};

/// When blocks are left.
V leaveBlock(const AxisLanes& axis, V block, V size, const Extent& extent) {
    const V border = hn::Min(hn::Mul(hn::Add(block, axis.ahead), size), set(extent.count));
    return axis.time(axis.timeOrigin, border, set(extent.cellSize));
}

/// The blocks of `size` cells in [low, high] that hold the time t: AxisWalk::cellAt(). Right in the
/// lanes `wanted`.
template <std::size_t n>
V blockAt(const Axis<n>& memory, std::size_t k, V t, V size, V low, V high, M wanted,
          const Extent& extent) {
    const AxisLanes axis(memory, k);
    const V zero = set(extent.zero);
    const V cellSize = set(extent.cellSize);
    const V count = set(extent.count);
    const V one = set(1.0);
    const V start = hn::Load(D(), memory.start + k);
    const V step = hn::Load(D(), memory.step + k);
    const V position = hn::Add(start, hn::Mul(t, hn::Load(D(), memory.direction + k)));
    const V guess = hn::Div(hn::Sub(position, zero), hn::Mul(cellSize, size));
    V block = hn::IfThenElse(hn::Ge(guess, low), guess, low);
    block = hn::Floor(hn::IfThenElse(hn::Le(block, high), block, high));
    const M parallel = hn::Eq(axis.timeOrigin, set(kForever));
    const V time = hn::IfThenElse(parallel, start, t);
    for (;;) {
        const V first = hn::Add(block, hn::Sub(one, axis.ahead));
        const V behind = hn::Add(block, axis.ahead);
        const V enter = axis.time(zero, hn::Min(hn::Mul(first, size), count), cellSize);
        const V leave = axis.time(zero, hn::Min(hn::Mul(behind, size), count), cellSize);
        const M early = hn::And(wanted, hn::Lt(time, enter));
        const M late = hn::And(wanted, hn::Ge(time, leave));
        if (hn::AllFalse(D(), hn::Or(early, late)))
            return block;
        block = hn::Sub(block, hn::IfThenElseZero(early, step));
        block = hn::Add(block, hn::IfThenElseZero(late, step));
    }
}

/// Makes the walks of tracks ready.
class Preparation {
public:
    Preparation(const TiledHeights& heights, const TrackBatch& batch)
        : m_heights(heights),
          m_batch(batch),
          m_x{heights.grid.x0, heights.grid.cellSize, double(heights.grid.columns)},
          m_y{heights.grid.y0, heights.grid.cellSize, double(heights.grid.rows)} {}

    /// Whether there is a walk left; it is then in walks() at index().
    bool next() {
        for (;;) {
            while (m_at < m_count) {
                if (m_walks.t[m_at] < m_walks.until[m_at])
                    return true;
                ++m_at;
            }
            if (m_done == m_batch.tracks.size())
                return false;
            prepare();
        }
    }
    void take() { ++m_at; }
    [[nodiscard]] const Walks<kPrepared>& walks() const { return m_walks; }
    [[nodiscard]] std::size_t index() const { return m_at; }

private:
    void prepare() {
        m_at = 0;
        m_count = std::min(kPrepared, m_batch.tracks.size() - m_done);
        for (std::size_t k = 0; k < m_count; ++k) {
            const Track& track = m_batch.tracks[m_done + k];
            m_walks.x.start[k] = track.originX;
            m_walks.y.start[k] = track.originY;
            m_walks.x.direction[k] = track.directionX;
            m_walks.y.direction[k] = track.directionY;
            m_walks.originZ[k] = track.originZ;
            m_walks.directionZ[k] = m_batch.directionZ[track.first];
            m_walks.next[k] = track.first;
            m_walks.last[k] = track.last;
        }
        const std::size_t lanes = hn::Lanes(D());
        for (std::size_t k = m_count; k < m_count + lanes && k < kPrepared; ++k) {
            m_walks.x.start[k] = m_walks.y.start[k] = m_walks.originZ[k] = 0.0;
            m_walks.x.direction[k] = m_walks.y.direction[k] = m_walks.directionZ[k] = 1.0;
        }
        for (std::size_t k = 0; k < m_count; k += lanes)
            prepareLanes(k);
        m_done += m_count;
    }

    /// An axis; `enter` and `leave`: of the grid.
    static void prepareAxis(Axis<kPrepared>& axis, std::size_t k, const Extent& extent, V& enter,
                            V& leave) {
        const D d;
        const V zero = hn::Zero(d);
        const V one = set(1.0);
        const V forever = set(kForever);
        const V start = hn::Load(d, axis.start + k);
        V direction = hn::Load(d, axis.direction + k);
        V inverse = hn::Div(one, direction);
        const M parallel = hn::Eq(hn::Abs(inverse), forever);
        direction = hn::IfThenElse(parallel, zero, direction);
        inverse = hn::IfThenElse(parallel, one, inverse);
        const M up = hn::Or(parallel, hn::Gt(direction, zero));
        const V ahead = hn::IfThenElse(up, one, zero);
        hn::Store(hn::IfThenElse(parallel, forever, set(extent.zero)), d, axis.timeOrigin + k);
        hn::Store(hn::IfThenElse(parallel, zero, start), d, axis.origin + k);
        hn::Store(inverse, d, axis.inverse + k);
        hn::Store(ahead, d, axis.ahead + k);
        hn::Store(hn::IfThenElse(up, one, set(-1.0)), d, axis.step + k);
        hn::Store(direction, d, axis.direction + k);

        const AxisLanes lanes(axis, k);
        const V cellSize = set(extent.cellSize);
        const V count = set(extent.count);
        const V near = lanes.time(lanes.timeOrigin, hn::IfThenElse(up, zero, count), cellSize);
        const V far = lanes.time(lanes.timeOrigin, hn::IfThenElse(up, count, zero), cellSize);
        const V end = hn::Add(set(extent.zero), hn::Mul(count, cellSize));
        const M inside = hn::And(hn::Ge(start, set(extent.zero)), hn::Lt(start, end));
        const V beside = hn::IfThenElse(inside, hn::Neg(forever), forever);
        enter = larger(enter, hn::IfThenElse(parallel, beside, near));
        leave = smaller(leave, far);
    }

    void prepareLanes(std::size_t k) {
        const D d;
        const V zero = hn::Zero(d);
        const V one = set(1.0);
        V enter = zero;
        V leave = set(kForever);
        prepareAxis(m_walks.x, k, m_x, enter, leave);
        prepareAxis(m_walks.y, k, m_y, enter, leave);
        const V originZ = hn::Load(d, m_walks.originZ + k);
        const V directionZ = hn::Load(d, m_walks.directionZ + k);
        const V margin =
            hn::Mul(set(1e-14), hn::Add(hn::Add(one, hn::Abs(originZ)), set(m_heights.magnitude)));
        const V crossing = hn::Mul(hn::Sub(hn::Add(set(m_heights.highest), margin), originZ),
                                   hn::Div(one, directionZ));
        const M falls = hn::Lt(directionZ, zero);
        const M rises = hn::Gt(directionZ, zero);
        const V t = hn::IfThenElse(falls, larger(enter, crossing), enter);
        const V until = hn::IfThenElse(rises, smaller(leave, crossing), leave);
        const M walks = hn::Lt(t, until);
        const V size = set(64.0);
        const V stride = set(double(m_heights.blockColumns));
        if (!hn::AllFalse(d, walks)) {
            const V lastRow = set(double(m_heights.blockRows - 1));
            hn::Store(blockAt(m_walks.x, k, t, size, zero, hn::Sub(stride, one), walks, m_x), d,
                      m_walks.i + k);
            hn::Store(blockAt(m_walks.y, k, t, size, zero, lastRow, walks, m_y), d, m_walks.j + k);
        }
        hn::Store(t, d, m_walks.t + k);
        hn::Store(until, d, m_walks.until + k);
        hn::Store(margin, d, m_walks.margin + k);
        hn::Store(size, d, m_walks.size + k);
        hn::Store(zero, d, m_walks.offset + k);
        hn::Store(stride, d, m_walks.stride + k);
        hn::Store(set(kForever), d, m_walks.leave8 + k);
        hn::Store(set(kForever), d, m_walks.leave64 + k);
        hn::Store(zero, d, m_walks.offset8 + k);
    }

    const TiledHeights& m_heights;
    const TrackBatch& m_batch;
    Extent m_x, m_y;
    Walks<kPrepared> m_walks;
    std::size_t m_done = 0;   ///< tracks made ready so far
    std::size_t m_count = 0;  ///< in m_walks
    std::size_t m_at = 0;     ///< the first of them that nobody took
};

/// Walks tracks, one in each lane.
class Walker {
public:
    Walker(const TiledHeights& heights, const CellSpans& spans, const TrackBatch& batch)
        : m_heights(heights),
          m_spans(spans),
          m_batch(batch),
          m_preparation(heights, batch),
          m_x{heights.grid.x0, heights.grid.cellSize, double(heights.grid.columns)},
          m_y{heights.grid.y0, heights.grid.cellSize, double(heights.grid.rows)} {}

    void run() {
        const std::size_t lanes = hn::Lanes(D());
        for (std::size_t lane = 0; lane < lanes; ++lane)
            refill(lane);
        while (m_active != 0)
            advance();
    }

private:
    using Lane = std::size_t;

    static unsigned bits(M mask) {
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(D(), mask, bytes);
        return bytes[0];
    }

    void refill(Lane lane) {
        if (m_preparation.next()) {
            copyWalk(m_walks, lane, m_preparation.walks(), m_preparation.index());
            m_preparation.take();
            m_active |= 1U << lane;
            return;
        }
        // Stands still at the first block, forever.
        m_active &= ~(1U << lane);
        m_walks.t[lane] = kForever;
        m_walks.until[lane] = -kForever;
        m_walks.i[lane] = m_walks.j[lane] = m_walks.offset[lane] = m_walks.stride[lane] = 0.0;
        m_walks.x.step[lane] = m_walks.y.step[lane] = 0.0;
        m_walks.size[lane] = 64.0;
        m_walks.leave8[lane] = m_walks.leave64[lane] = kForever;
    }

    /// Each lane passes over a block, or goes into it, or asks a column.
    void advance() {
        const D d;
        Walks<kMostLanes>& w = m_walks;
        const V zero = hn::Zero(d);
        const V one = set(1.0);
        V t = hn::Load(d, w.t);
        V i = hn::Load(d, w.i);
        V j = hn::Load(d, w.j);
        V size = hn::Load(d, w.size);
        V offset = hn::Load(d, w.offset);
        V stride = hn::Load(d, w.stride);
        V leave8 = hn::Load(d, w.leave8);
        V leave64 = hn::Load(d, w.leave64);
        const V leaveX = leaveBlock(AxisLanes(w.x, 0), i, size, m_x);
        const V leaveY = leaveBlock(AxisLanes(w.y, 0), j, size, m_y);
        const V leave = hn::Min(leaveX, leaveY);

        const V at = hn::Add(offset, hn::Add(hn::Mul(j, stride), i));
        const hn::Rebind<std::int32_t, D> di;
        const hn::Rebind<float, D> df;
        const V maximum =
            hn::PromoteTo(d, hn::GatherIndex(df, m_heights.maximum.data(), hn::DemoteTo(di, at)));
        const V directionZ = hn::Load(d, w.directionZ);
        const M falls = hn::Lt(directionZ, zero);
        const V lowest =
            hn::Add(hn::Load(d, w.originZ), hn::Mul(hn::IfThenElse(falls, leave, t), directionZ));
        const M passes = hn::Gt(lowest, hn::Add(maximum, hn::Load(d, w.margin)));
        const M meets = hn::AndNot(passes, hn::Lt(t, leave));
        const M cells = hn::Eq(size, one);

        if (const unsigned asked = bits(hn::And(meets, cells)) & m_active; asked != 0) {
            alignas(64) double leaves[kMostLanes];
            alignas(64) double positions[kMostLanes];
            hn::Store(leave, d, leaves);
            hn::Store(at, d, positions);
            for (unsigned rest = asked; rest != 0; rest &= rest - 1) {
                const auto lane = Lane(std::countr_zero(rest));
                askColumn(lane, std::size_t(positions[lane]), leaves[lane]);
            }
        }

        // Into the block, where the ray is in it at time t.
        const M down = hn::AndNot(cells, meets);
        if (!hn::AllFalse(d, down)) {
            const V child = hn::IfThenElse(down, hn::Mul(size, set(0.125)), size);
            const V eight = set(8.0);
            const V lowI = hn::Mul(i, eight);
            const V lowJ = hn::Mul(j, eight);
            const V childI = blockAt(w.x, 0, t, child, lowI, hn::Add(lowI, set(7.0)), down, m_x);
            const V childJ = blockAt(w.y, 0, t, child, lowJ, hn::Add(lowJ, set(7.0)), down, m_y);
            const M toCells = hn::And(down, hn::Eq(child, one));
            const M toBlocks = hn::AndNot(toCells, down);
            leave8 = hn::IfThenElse(toCells, leave, leave8);
            leave64 = hn::IfThenElse(toBlocks, leave, leave64);
            const V parts = hn::Add(hn::Mul(at, set(64.0)), set(double(m_heights.blocks())));
            const V childOffset = hn::Sub(parts, hn::Add(hn::Mul(j, set(64.0)), lowI));
            offset = hn::IfThenElse(down, childOffset, offset);
            stride = hn::IfThenElse(down, eight, stride);
            const V offset8 = hn::IfThenElse(toBlocks, offset, hn::Load(d, w.offset8));
            hn::Store(offset8, d, w.offset8);
            size = child;
            i = hn::IfThenElse(down, childI, i);
            j = hn::IfThenElse(down, childJ, j);
        }

        // On to the next one; through a corner both steps are due at once.
        t = hn::IfThenElse(down, t, leave);
        const M stepX = hn::AndNot(down, hn::Le(leaveX, leave));
        const M stepY = hn::AndNot(down, hn::Le(leaveY, leave));
        i = hn::Add(i, hn::IfThenElseZero(stepX, hn::Load(d, w.x.step)));
        j = hn::Add(j, hn::IfThenElseZero(stepY, hn::Load(d, w.y.step)));

        // Out of the blocks around.
        const M up64 = hn::Ge(t, leave64);
        const M up8 = hn::AndNot(up64, hn::Ge(t, leave8));
        const M up = hn::Or(up64, up8);
        if (!hn::AllFalse(d, up)) {
            V factor = hn::IfThenElse(up8, set(0.125), one);
            factor = hn::IfThenElse(up64, hn::Mul(size, set(1.0 / 64.0)), factor);
            i = hn::Floor(hn::Mul(i, factor));
            j = hn::Floor(hn::Mul(j, factor));
            size = hn::IfThenElse(up64, set(64.0), hn::IfThenElse(up8, set(8.0), size));
            offset =
                hn::IfThenElse(up64, zero, hn::IfThenElse(up8, hn::Load(d, w.offset8), offset));
            stride = hn::IfThenElse(up64, set(double(m_heights.blockColumns)), stride);
            leave8 = hn::IfThenElse(up, set(kForever), leave8);
            leave64 = hn::IfThenElse(up64, set(kForever), leave64);
        }
        hn::Store(t, d, w.t);
        hn::Store(i, d, w.i);
        hn::Store(j, d, w.j);
        hn::Store(size, d, w.size);
        hn::Store(offset, d, w.offset);
        hn::Store(stride, d, w.stride);
        hn::Store(leave8, d, w.leave8);
        hn::Store(leave64, d, w.leave64);
        for (unsigned done = bits(hn::Ge(t, hn::Load(d, w.until))) & m_active; done != 0;
             done &= done - 1)
            refill(Lane(std::countr_zero(done)));
    }

    /// The number of the cell at a position of the tiled heights.
    [[nodiscard]] std::uint32_t cellOf(Lane lane) const {
        return std::uint32_t(m_heights.grid.index(int(m_walks.i[lane]), int(m_walks.j[lane])));
    }

    void hit(std::uint32_t ray, double t, std::uint32_t cell) {
        m_batch.t[ray] = t;
        if (m_batch.cell != nullptr)
            m_batch.cell[ray] = cell;
    }

    /// Which rays of the track meet the column; the rest goes on.
    void askColumn(Lane lane, std::size_t position, double leave) {
        Walks<kMostLanes>& w = m_walks;
        const double height = double(m_heights.maximum[position]);
        const double t = w.t[lane];
        const std::uint32_t cell = cellOf(lane);
        std::uint32_t next = w.next[lane];
        const std::uint32_t last = w.last[lane];
        const auto column = m_spans.at(cell);
        if (column.empty()) {
            // A missing cell, where the ray's height overflows, is no column.
            for (; next < last && height > -kForever; ++next) {
                const HeightWalk z(w.originZ[lane], m_batch.directionZ[next]);
                const double found = z.meets(height, t, leave);
                if (!std::isfinite(found))
                    break;
                hit(m_batch.ray[next], found, cell);
            }
        } else {
            next = askHollow(lane, column, t, leave, cell);
        }
        if (next == w.next[lane])
            return;
        w.next[lane] = next;
        if (next == last) {
            w.until[lane] = -kForever;
            return;
        }
        const double directionZ = m_batch.directionZ[next];
        w.directionZ[lane] = directionZ;
        if (directionZ > 0.0) {
            const HeightWalk z(w.originZ[lane], directionZ);
            const double crossing = z.timeAt(m_heights.highest + w.margin[lane]);
            w.until[lane] = std::min(w.until[lane], crossing);
        }
    }

    /// The rays that a hollow column stops may be any: moves the others together, up to the end.
    std::uint32_t askHollow(Lane lane, std::span<const HeightSpan> column, double t, double leave,
                            std::uint32_t cell) {
        std::uint32_t kept = m_walks.last[lane];
        for (std::uint32_t ray = m_walks.last[lane]; ray-- > m_walks.next[lane];) {
            const HeightWalk z(m_walks.originZ[lane], m_batch.directionZ[ray]);
            const double found = z.meets(column, t, leave);
            if (std::isfinite(found)) {
                hit(m_batch.ray[ray], found, cell);
                continue;
            }
            --kept;
            m_batch.directionZ[kept] = m_batch.directionZ[ray];
            m_batch.ray[kept] = m_batch.ray[ray];
        }
        return kept;
    }

    const TiledHeights& m_heights;
    const CellSpans& m_spans;
    const TrackBatch& m_batch;
    Preparation m_preparation;
    Extent m_x, m_y;
    Walks<kMostLanes> m_walks{};  // lanes that never get a track are read all the same
    unsigned m_active = 0;        ///< lanes that walk, a bit each
};

}  // namespace

void walkTracksWide(const TiledHeights& heights, const CellSpans& spans, const TrackBatch& batch) {
    Walker(heights, spans, batch).run();
}

}  // namespace reflet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace reflet {

HWY_EXPORT(walkTracksWide);

bool canWalk(const TiledHeights& heights) {
    return heights.maximum.size() < std::size_t(std::numeric_limits<std::int32_t>::max());
}

void walkTracks(const TiledHeights& heights, const CellSpans& spans, const TrackBatch& batch) {
    HWY_DYNAMIC_DISPATCH(walkTracksWide)(heights, spans, batch);
}

std::vector<std::string> walkTargets() {
    std::vector<std::string> names;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        names.emplace_back(hwy::TargetName(target));
    return names;
}

void useWalkTarget(const std::string& name) {
    hwy::SetSupportedTargetsForTest(0);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (name == hwy::TargetName(target)) {
            hwy::SetSupportedTargetsForTest(target);
            break;
        }
    }
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace reflet
#endif
