// SPDX-License-Identifier: GPL-3.0-or-later
// Part of TrackWalk.cpp, for each instruction set once more.
#if defined(REFLET_CORE_HEIGHTFIELD_WALK_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef REFLET_CORE_HEIGHTFIELD_WALK_LANES_INL
#undef REFLET_CORE_HEIGHTFIELD_WALK_LANES_INL
#else
#define REFLET_CORE_HEIGHTFIELD_WALK_LANES_INL
#endif

#include "core/heightfield/TiledHeights.h"

#include <cstdint>
#include <hwy/highway.h>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace reflet::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

constexpr std::size_t kMostLanes = 8;
/// Vectors of tracks that are walked in turns: while one waits for its heights, the other goes on.
constexpr std::size_t kSets = 2;
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
    alignas(64) double held[n];  ///< 1: it waits for what advance() does not do
    std::uint32_t next[n];       ///< that ray
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
    to.held[lane] = 0.0;
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
/// lanes `wanted`. guessScale: blocks to a metre, nearly; the borders' times decide.
template <std::size_t n>
HWY_INLINE V blockAt(const Axis<n>& memory, std::size_t k, V t, V size, V guessScale, V low, V high,
                     M wanted, const Extent& extent) {
    const AxisLanes axis(memory, k);
    const V zero = set(extent.zero);
    const V cellSize = set(extent.cellSize);
    const V count = set(extent.count);
    const V one = set(1.0);
    const V start = hn::Load(D(), memory.start + k);
    const V step = hn::Load(D(), memory.step + k);
    const V position = hn::Add(start, hn::Mul(t, hn::Load(D(), memory.direction + k)));
    const V guess = hn::Mul(hn::Sub(position, zero), guessScale);
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

/// What several walks see of the blocks that they are at.
struct Look {
    V t, i, j, size;
    V leaveX, leaveY, leave;  ///< when the block is left
    V at;                     ///< its place in the tiled heights
    V maximum;                ///< its height
    M goes;                   ///< it is not held up
    M meets;                  ///< the lowest ray may meet something in it

    template <std::size_t n>
    HWY_INLINE Look(const TiledHeights& heights, const Walks<n>& w, std::size_t k,
                    const Extent& extentX, const Extent& extentY) {
        const D d;
        t = hn::Load(d, w.t + k);
        i = hn::Load(d, w.i + k);
        j = hn::Load(d, w.j + k);
        size = hn::Load(d, w.size + k);
        leaveX = leaveBlock(AxisLanes(w.x, k), i, size, extentX);
        leaveY = leaveBlock(AxisLanes(w.y, k), j, size, extentY);
        leave = hn::Min(leaveX, leaveY);
        goes = hn::Lt(hn::Load(d, w.held + k), set(0.5));
        // Those that are held up may be beside their block, or beside the grid.
        at = hn::IfThenElseZero(goes, hn::Add(hn::Load(d, w.offset + k),
                                              hn::Add(hn::Mul(j, hn::Load(d, w.stride + k)), i)));
        const hn::Rebind<std::int32_t, D> di;
        const hn::Rebind<float, D> df;
        maximum =
            hn::PromoteTo(d, hn::GatherIndex(df, heights.maximum.data(), hn::DemoteTo(di, at)));
        const V directionZ = hn::Load(d, w.directionZ + k);
        const M falls = hn::Lt(directionZ, hn::Zero(d));
        const V lowest = hn::Add(hn::Load(d, w.originZ + k),
                                 hn::Mul(hn::IfThenElse(falls, leave, t), directionZ));
        const M passes = hn::Gt(lowest, hn::Add(maximum, hn::Load(d, w.margin + k)));
        meets = hn::AndNot(passes, hn::Lt(t, leave));
    }
};

/// From the blocks of the lanes `down` into their parts, where the rays are in them at time t.
template <std::size_t n>
HWY_INLINE void goDown(const TiledHeights& heights, Walks<n>& w, std::size_t k, const Look& look,
                       M down, const Extent& extentX, const Extent& extentY) {
    const D d;
    const V one = set(1.0);
    const V eight = set(8.0);
    const V child = hn::IfThenElse(down, hn::Mul(look.size, set(0.125)), look.size);
    const V lowI = hn::Mul(look.i, eight);
    const V lowJ = hn::Mul(look.j, eight);
    const V perCell = set(1.0 / heights.grid.cellSize);
    const M toCells = hn::And(down, hn::Eq(child, one));
    const M toBlocks = hn::AndNot(toCells, down);
    const V scale = hn::IfThenElse(toCells, perCell, hn::Mul(perCell, set(0.125)));
    const V seven = set(7.0);
    const V i = blockAt(w.x, k, look.t, child, scale, lowI, hn::Add(lowI, seven), down, extentX);
    const V j = blockAt(w.y, k, look.t, child, scale, lowJ, hn::Add(lowJ, seven), down, extentY);
    const V parts = hn::Add(hn::Mul(look.at, set(64.0)), set(double(heights.blocks())));
    const V offset = hn::IfThenElse(down, hn::Sub(parts, hn::Add(hn::Mul(look.j, set(64.0)), lowI)),
                                    hn::Load(d, w.offset + k));
    hn::Store(hn::IfThenElse(toCells, look.leave, hn::Load(d, w.leave8 + k)), d, w.leave8 + k);
    hn::Store(hn::IfThenElse(toBlocks, look.leave, hn::Load(d, w.leave64 + k)), d, w.leave64 + k);
    hn::Store(offset, d, w.offset + k);
    hn::Store(hn::IfThenElse(toBlocks, offset, hn::Load(d, w.offset8 + k)), d, w.offset8 + k);
    hn::Store(hn::IfThenElse(down, eight, hn::Load(d, w.stride + k)), d, w.stride + k);
    hn::Store(child, d, w.size + k);
    hn::Store(hn::IfThenElse(down, i, look.i), d, w.i + k);
    hn::Store(hn::IfThenElse(down, j, look.j), d, w.j + k);
}

/// Out of the blocks around that were left.
template <std::size_t n>
HWY_INLINE void goUp(const TiledHeights& heights, Walks<n>& w, std::size_t k) {
    const D d;
    const V t = hn::Load(d, w.t + k);
    const V leave8 = hn::Load(d, w.leave8 + k);
    const V leave64 = hn::Load(d, w.leave64 + k);
    // Lanes without a track stand at infinity.
    const M walks = hn::Lt(t, set(kForever));
    const M up64 = hn::And(walks, hn::Ge(t, leave64));
    const M up8 = hn::AndNot(up64, hn::And(walks, hn::Ge(t, leave8)));
    const M up = hn::Or(up64, up8);
    if (hn::AllFalse(d, up))
        return;
    const V one = set(1.0);
    const V size = hn::Load(d, w.size + k);
    V factor = hn::IfThenElse(up8, set(0.125), one);
    factor = hn::IfThenElse(up64, hn::Mul(size, set(1.0 / 64.0)), factor);
    hn::Store(hn::Floor(hn::Mul(hn::Load(d, w.i + k), factor)), d, w.i + k);
    hn::Store(hn::Floor(hn::Mul(hn::Load(d, w.j + k), factor)), d, w.j + k);
    hn::Store(hn::IfThenElse(up64, set(64.0), hn::IfThenElse(up8, set(8.0), size)), d, w.size + k);
    const V offset = hn::IfThenElse(up8, hn::Load(d, w.offset8 + k), hn::Load(d, w.offset + k));
    hn::Store(hn::IfThenElse(up64, hn::Zero(d), offset), d, w.offset + k);
    hn::Store(hn::IfThenElse(up64, set(double(heights.blockColumns)), hn::Load(d, w.stride + k)), d,
              w.stride + k);
    hn::Store(hn::IfThenElse(up, set(kForever), leave8), d, w.leave8 + k);
    hn::Store(hn::IfThenElse(up64, set(kForever), leave64), d, w.leave64 + k);
}

/// The number of the cell that a lane is in.
template <std::size_t n>
std::uint32_t cellOf(const GridSpec& grid, const Walks<n>& w, std::size_t lane) {
    return std::uint32_t(grid.index(int(w.i[lane]), int(w.j[lane])));
}

/// A bit for each lane.
unsigned bits(M mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(D(), mask, bytes);
    return bytes[0];
}

}  // namespace
}  // namespace reflet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
